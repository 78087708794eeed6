// Numbers out of a glTF file's accessors.
#pragma once

#include <glm/vec4.hpp>

#include "tools/bake/mesh/gltf_buffers.h"

namespace overlook::mesh::gltf {

// The elements of an attribute, each of up to four components. Holds its own copy only where sparse values replace some.
class Elements {
  public:
    size_t size() const { return count_; }
    uint32_t width() const { return width_; }
    // Element i < size() as numbers: those of a normalized accessor 0..1 or -1..1, of others as stored; missing components 0, 0,
    // 0, 1.
    glm::dvec4 operator[](size_t i) const;
    // Component 0 of element i as a whole number; the component type is an unsigned one.
    uint32_t whole(size_t i) const;

  private:
    friend class Accessors;
    const std::byte* begin_ = nullptr;
    size_t count_ = 0, stride_ = 0;
    uint32_t width_ = 1;
    Component component_ = Component::float32;
    bool is_normalized_ = false;
    std::shared_ptr<std::vector<std::byte>> owned_;
};

class Accessors {
  public:
    Accessors(const Document& document, Buffers& buffers, const std::string& name)
        : document_(document), buffers_(buffers), name_(name) {}

    // An attribute whose elements have `least` to `most` components. Fails with Exit::bad_input:
    //   "a.glb: accessor 3 reaches to byte 1200 of its buffer view, which has 1000; was the file cut short?"
    Result<Elements> attribute(uint32_t index, uint32_t least, uint32_t most);
    // Whole numbers without a sign.
    Result<Elements> indices(uint32_t index);

  private:
    Result<Elements> elements(uint32_t index);
    Result<Elements> place(Bytes view, uint64_t stride, const Accessor& accessor, uint32_t index) const;
    Result<void> replace_sparse(const Accessor& accessor, uint32_t index, Elements& elements);

    const Document& document_;
    Buffers& buffers_;
    const std::string& name_;
};

}  // namespace overlook::mesh::gltf
