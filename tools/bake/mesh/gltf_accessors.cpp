// Accessors. Source: glTF 2.0 Specification, section 3.6.2.

#include "tools/bake/mesh/gltf_accessors.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "formats/little_endian.h"

namespace overlook::mesh::gltf {
namespace {

// An accessor without a view is all zeros; more of them than this serve nobody.
constexpr uint64_t kMostZeros = 1 << 24;

double number_at(const std::byte* at, Component component, bool is_normalized) {
    const auto signed_unit = [&](double value, double greatest) {
        return is_normalized ? std::max(value / greatest, -1.0) : value;
    };
    const auto unit = [&](double value, double greatest) { return is_normalized ? value / greatest : value; };
    switch (component) {
        case Component::int8:
            return signed_unit(double(int8_t(load_le<uint8_t>({at, 1}, 0))), 127);
        case Component::uint8:
            return unit(double(load_le<uint8_t>({at, 1}, 0)), 255);
        case Component::int16:
            return signed_unit(double(int16_t(load_le<uint16_t>({at, 2}, 0))), 32767);
        case Component::uint16:
            return unit(double(load_le<uint16_t>({at, 2}, 0)), 65535);
        case Component::uint32:
            return unit(double(load_le<uint32_t>({at, 4}, 0)), 4294967295.0);
        default:
            return double(std::bit_cast<float>(load_le<uint32_t>({at, 4}, 0)));
    }
}

uint32_t whole_at(const std::byte* at, Component component) {
    switch (component) {
        case Component::uint8:
            return load_le<uint8_t>({at, 1}, 0);
        case Component::uint16:
            return load_le<uint16_t>({at, 2}, 0);
        default:
            return load_le<uint32_t>({at, 4}, 0);
    }
}

bool is_unsigned(Component component) {
    return component == Component::uint8 || component == Component::uint16 || component == Component::uint32;
}

}  // namespace

glm::dvec4 Elements::operator[](size_t i) const {
    glm::dvec4 values(0, 0, 0, 1);
    const std::byte* at = begin_ + i * stride_;
    for (uint32_t k = 0; k < width_; ++k) values[int(k)] = number_at(at + k * size_bytes(component_), component_, is_normalized_);
    return values;
}

uint32_t Elements::whole(size_t i) const {
    return whole_at(begin_ + i * stride_, component_);
}

Result<Elements> Accessors::place(Bytes view, uint64_t stride, const Accessor& accessor, uint32_t index) const {
    const uint64_t element_bytes = uint64_t(accessor.width) * size_bytes(accessor.component);
    Elements elements;
    elements.count_ = size_t(accessor.count);
    elements.stride_ = size_t(stride == 0 ? element_bytes : stride);
    elements.width_ = accessor.width;
    elements.component_ = accessor.component;
    elements.is_normalized_ = accessor.is_normalized;
    // Strides are below 2^53 and counts too; whether the last element fits is asked without their product.
    const bool begins_within = accessor.offset <= view.size() && element_bytes <= view.size() - accessor.offset;
    const uint64_t most = begins_within ? (view.size() - accessor.offset - element_bytes) / elements.stride_ + 1 : 0;
    if (accessor.count > most)
        return bad_input("{}: accessor {} has {} elements, but its buffer view holds {}; was the file cut short?", name_, index,
                         accessor.count, most);
    elements.begin_ = view.data() + (accessor.count == 0 ? 0 : accessor.offset);
    return elements;
}

Result<Elements> Accessors::elements(uint32_t index) {
    const Accessor& accessor = document_.accessors[index];
    if (accessor.width == 0) return bad_input("{}: accessor {} is of a type that no vertex has", name_, index);
    Result<Elements> elements;
    if (accessor.view != kNone) {
        const Result<Bytes> view = buffers_.view(accessor.view);
        if (!view) return tl::unexpected(view.error());
        const View& said = document_.views[accessor.view];
        elements = place(*view, said.compression ? said.compression->stride : said.stride, accessor, index);
    } else {
        if (accessor.count > kMostZeros)
            return bad_input("{}: accessor {} has {} elements and no bytes", name_, index, accessor.count);
        auto zeros =
            std::make_shared<std::vector<std::byte>>(size_t(accessor.count) * accessor.width * size_bytes(accessor.component));
        Accessor whole = accessor;
        whole.offset = 0;
        elements = place(*zeros, 0, whole, index);
        if (elements) elements->owned_ = std::move(zeros);
    }
    if (!elements || !accessor.sparse) return elements;
    if (auto r = replace_sparse(accessor, index, *elements); !r) return tl::unexpected(r.error());
    return elements;
}

// Copies the elements tightly and puts the sparse values in their places.
Result<void> Accessors::replace_sparse(const Accessor& accessor, uint32_t index, Elements& elements) {
    const Sparse& sparse = *accessor.sparse;
    if (!is_unsigned(sparse.index_component)) return bad_input("{}: accessor {} has sparse indices with a sign", name_, index);
    const Result<Bytes> index_view = buffers_.view(sparse.index_view), value_view = buffers_.view(sparse.value_view);
    if (!index_view) return tl::unexpected(index_view.error());
    if (!value_view) return tl::unexpected(value_view.error());
    Accessor where, what = accessor;
    where.count = what.count = sparse.count;
    where.offset = sparse.index_offset;
    where.component = sparse.index_component;
    what.offset = sparse.value_offset;
    const Result<Elements> places = place(*index_view, 0, where, index), values = place(*value_view, 0, what, index);
    if (!places) return tl::unexpected(places.error());
    if (!values) return tl::unexpected(values.error());

    const size_t element_bytes = accessor.width * size_bytes(accessor.component);
    auto copy = std::make_shared<std::vector<std::byte>>(elements.count_ * element_bytes);
    for (size_t i = 0; i < elements.count_; ++i)
        std::memcpy(copy->data() + i * element_bytes, elements.begin_ + i * elements.stride_, element_bytes);
    for (size_t i = 0; i < places->size(); ++i) {
        const uint32_t to = places->whole(i);
        if (to >= elements.count_)
            return bad_input("{}: accessor {} has a sparse value for element {} of {}", name_, index, to, elements.count_);
        std::memcpy(copy->data() + to * element_bytes, values->begin_ + i * values->stride_, element_bytes);
    }
    elements.begin_ = copy->data();
    elements.stride_ = element_bytes;
    elements.owned_ = std::move(copy);
    return {};
}

Result<Elements> Accessors::attribute(uint32_t index, uint32_t least, uint32_t most) {
    Result<Elements> read = elements(index);
    if (read && (read->width() < least || read->width() > most))
        return bad_input("{}: accessor {} has {} components, {} to {} are wanted", name_, index, read->width(), least, most);
    return read;
}

Result<Elements> Accessors::indices(uint32_t index) {
    const Accessor& accessor = document_.accessors[index];
    if (!is_unsigned(accessor.component) || accessor.width != 1)
        return bad_input("{}: accessor {} holds indices that are no unsigned whole numbers", name_, index);
    return elements(index);
}

}  // namespace overlook::mesh::gltf
