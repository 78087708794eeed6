// GDAL's own tag in a GeoTIFF (42112), as far as it says what stored numbers mean: height = offset + scale * number.
#pragma once

#include <string>
#include <string_view>

#include "formats/result.h"

namespace overlook::dem {

struct ValueScale {
    double scale = 1;
    double offset = 0;
};

// The scale and offset of the first channel; 1 and 0 where the text has none. `xml` may be hostile. Looks for
// <Item name="SCALE" sample="0" role="scale">0.1</Item> and the same with OFFSET; everything else is passed over. Fails with
// Exit::bad_input:
//   "NAME: GDAL_METADATA gives a scale of \"x\"; a number other than 0 is wanted"
Result<ValueScale> value_scale_of(std::string_view xml, const std::string& name);

}  // namespace overlook::dem
