// Does a picture show only what the error that was promised of a height field lets it show?
#pragma once

#include "tools/measure/frame.h"

namespace overlook::measure {

// A height field whose samples stand at most promised_px from their places on the screen, each above or below its own place,
// shows at pixel (x, y) of `test` more than the reference does only where lowered ground before it, or itself lowered, lets it:
// raised by as much, what is shown there is before the reference's surface; and on the way up the test shows nothing nearer, for
// above ground one sees is farther ground or none. So: raised along its own vertical by some whole number of pixels up to
// promised_px + 1.5 (the slack of pixels' middles) on the screen, it comes before what the reference shows there or one pixel
// beside, or background meets background; and no pixel passed shows ground more than 1 % nearer, measured along the level. A
// crack has such ground above it, however much was promised. wide_reference: the reference with `margin_px` more pixels on every
// side; what lies farther outside shows nothing. promised_px: 0..64 (callers that promise more get no more). (x, y) in the test's
// pixels. Holds for cameras without roll that stand above the ground. O(promised_px).
bool is_within_promise(const Frame& test, const Frame& wide_reference, int margin_px, double promised_px, int x, int y);

}  // namespace overlook::measure
