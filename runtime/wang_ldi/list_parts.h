// What there is to do for the items of a list.
#pragma once

#include <cstddef>
#include <vector>

#include "runtime/wang_ldi/field.h"

namespace overlook::wang_ldi {

// Cuts the list in parts of about as many samples and texels each, `most` of them at most and at least one; returns where each
// ends, the last with the list.
std::vector<size_t> parts_of(const Field& field, const FieldList& list, unsigned most);

// How wide the widest splat of an item is, in metres of the place where it is; as the file has them if its images say so by
// themselves (at most 16 pixels of a level).
double widest_splat_m(const Field& field, const FieldList& list, const Item& item);

// The greatest step of height of any level: a sample may stand so much above what its tile says is highest.
double highest_step_m(const ImageSet& images);

}  // namespace overlook::wang_ldi
