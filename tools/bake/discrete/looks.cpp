#include "tools/bake/discrete/looks.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "formats/srgb.h"

namespace overlook::discrete {
namespace {

uint32_t wrapped(double at, uint32_t size) {
    double whole = std::floor(at), wide = double(size);
    return std::min(uint32_t(whole - wide * std::floor(whole / wide)), size - 1);
}

const uint8_t* pixel(const PictureRgba8& picture, double x, double y) {
    return picture.pixels.data() + 4 * (size_t(wrapped(y, picture.height)) * picture.width + wrapped(x, picture.width));
}

glm::dvec2 uv_at(const Shape& shape, size_t face, const glm::dvec3& weights) {
    glm::dvec2 uv(0);
    for (size_t c = 0; c < 3; ++c) uv += weights[int(c)] * glm::dvec2(shape.vertices[shape.faces[face][c]].uv);
    return uv;
}

}  // namespace

glm::dvec3 linear_of_srgb(const glm::dvec3& encoded) {
    return {linear_from_srgb(encoded.x), linear_from_srgb(encoded.y), linear_from_srgb(encoded.z)};
}
glm::dvec3 srgb_of_linear(const glm::dvec3& linear) {
    return {srgb_from_linear(linear.x), srgb_from_linear(linear.y), srgb_from_linear(linear.z)};
}

Result<Looks> Looks::make(std::span<const caveclod::Surface> surfaces) {
    Looks made;
    std::map<std::string, int> by_name;
    for (const caveclod::Surface& surface : surfaces) {
        Look look;
        glm::dvec3 colour(surface.colour[0], surface.colour[1], surface.colour[2]);
        look.colour = {linear_of_srgb(colour / 255.0), surface.colour[3] / 255.0};
        look.is_masked = surface.is_alpha_masked, look.cutoff = double(surface.alpha_cutoff);
        if (!surface.texture_bytes.empty() && !by_name.contains(surface.texture)) {
            auto picture = picture_rgba8(surface.texture, surface.texture_bytes);
            if (!picture && picture.error().exit != Exit::bad_input) return tl::unexpected(picture.error());
            by_name[surface.texture] = picture ? int(made.pictures_.size()) : -1;
            if (picture) made.pictures_.push_back(std::move(*picture));
        }
        auto found = by_name.find(surface.texture);
        if (!surface.texture.empty() && found != by_name.end()) look.picture = found->second;
        made.looks_.push_back(look);
    }
    return made;
}

uint32_t Looks::add_picture(const PictureRgba8& picture, double cutoff) {
    looks_.push_back({glm::dvec4(1), int(pictures_.size()), true, cutoff});
    pictures_.push_back(picture);
    return uint32_t(looks_.size() - 1);
}

// Between the four pixels round it, as it is drawn.
double Looks::opacity_at(const PictureRgba8& picture, const glm::dvec2& uv) const {
    double x = uv.x * picture.width - 0.5, y = uv.y * picture.height - 0.5, right = x - std::floor(x), down = y - std::floor(y);
    double upper = (1 - right) * pixel(picture, x, y)[3] + right * pixel(picture, x + 1, y)[3];
    double lower = (1 - right) * pixel(picture, x, y + 1)[3] + right * pixel(picture, x + 1, y + 1)[3];
    return ((1 - down) * upper + down * lower) / 255;
}

glm::dvec4 Looks::at(const Shape& shape, size_t face, const glm::dvec3& weights) const {
    const Look& look = looks_[shape.face_surface[face]];
    glm::dvec4 own = look.colour, tint(0);
    for (size_t c = 0; c < 3; ++c) {
        const std::array<uint8_t, 4>& colour = shape.vertices[shape.faces[face][c]].colour;
        glm::dvec3 encoded(colour[0], colour[1], colour[2]);
        tint += weights[int(c)] * glm::dvec4(linear_of_srgb(encoded / 255.0), colour[3] / 255.0);
    }
    own *= tint;
    if (look.picture < 0) return own;
    const PictureRgba8& picture = pictures_[size_t(look.picture)];
    glm::dvec2 uv = uv_at(shape, face, weights);
    const uint8_t* nearest = pixel(picture, uv.x * picture.width, uv.y * picture.height);
    glm::dvec3 encoded(nearest[0], nearest[1], nearest[2]);
    return own * glm::dvec4(linear_of_srgb(encoded / 255.0), opacity_at(picture, uv));
}

bool Looks::is_drawn(const Shape& shape, size_t face, const glm::dvec3& weights) const {
    const Look& look = looks_[shape.face_surface[face]];
    if (!look.is_masked) return true;
    double opacity = look.colour.w, tint = 0;
    for (size_t c = 0; c < 3; ++c) tint += weights[int(c)] * shape.vertices[shape.faces[face][c]].colour[3] / 255.0;
    if (look.picture >= 0) opacity *= opacity_at(pictures_[size_t(look.picture)], uv_at(shape, face, weights));
    return opacity * tint >= look.cutoff;
}

}  // namespace overlook::discrete
