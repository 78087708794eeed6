// What the memory of this machine can do, to hold times against.
#pragma once

namespace overlook::measure {

// Bytes a second that all threads together move through memory: the triad a[i] = b[i] + s * c[i] over arrays far larger than any
// cache, counted as three times eight bytes an element (McCalpin's STREAM). In 10^9 bytes a second. Takes 400 MB for a second.
double memory_bandwidth_gb_s();

}  // namespace overlook::measure
