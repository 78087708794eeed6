// Parts with their poses, and visibility, as bytes, and back.
#include <algorithm>

#include "formats/discrete_layout.h"

namespace overlook::discrete {
namespace {

// Bytes added at the end.
class Sink {
  public:
    void u32(uint32_t value) {
        bytes.resize(bytes.size() + 4);
        store_le<uint32_t>(bytes, bytes.size() - 4, value);
    }
    void f32(float value) { u32(std::bit_cast<uint32_t>(value)); }
    void add(std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

    std::vector<std::byte> bytes;
};

// Bytes from front to back; what is missing is never read, and says so.
class Scan {
  public:
    explicit Scan(std::span<const std::byte> bytes) : bytes_(bytes) {}
    uint32_t u32() {
        std::span<const std::byte> taken = take(4);
        return taken.empty() ? 0 : load_le<uint32_t>(taken, 0);
    }
    float f32() { return std::bit_cast<float>(u32()); }
    std::span<const std::byte> take(uint64_t size) {
        is_whole_ = is_whole_ && size <= bytes_.size();
        if (!is_whole_) return {};
        std::span<const std::byte> taken = bytes_.first(size_t(size));
        bytes_ = bytes_.subspan(size_t(size));
        return taken;
    }
    bool is_whole() const { return is_whole_; }
    uint64_t rest() const { return bytes_.size(); }

  private:
    std::span<const std::byte> bytes_;
    bool is_whole_ = true;
};

bool is_printable(const std::string& text) {
    return std::none_of(text.begin(), text.end(), [](char c) { return uint8_t(c) < ' ' || uint8_t(c) == 127; });
}

bool take_part(Scan& scan, Part& part) {
    uint32_t name_bytes = scan.u32();
    if (name_bytes > kNameBytesMax) return false;
    std::span<const std::byte> name = scan.take(name_bytes);
    part.name.assign(reinterpret_cast<const char*>(name.data()), name.size());
    for (int axis = 0; axis < 3; ++axis) part.pivot_m[axis] = scan.f32();
    uint32_t key_count = scan.u32();
    if (!scan.is_whole() || !is_printable(part.name) || uint64_t(key_count) * kKeyBytes > scan.rest()) return false;
    for (uint32_t key = 0; key < key_count; ++key) {
        part.at_s.push_back(scan.f32());
        Pose pose;
        for (float* number : {&pose.turn.w, &pose.turn.x, &pose.turn.y, &pose.turn.z}) *number = scan.f32();
        for (int axis = 0; axis < 3; ++axis) pose.move_m[axis] = scan.f32();
        part.poses.push_back(pose);
    }
    return true;
}

}  // namespace

std::vector<std::byte> bytes_of_parts(const std::vector<Part>& parts) {
    Sink sink;
    for (const Part& part : parts) {
        sink.u32(uint32_t(part.name.size()));
        sink.add(std::as_bytes(std::span(part.name)));
        for (int axis = 0; axis < 3; ++axis) sink.f32(part.pivot_m[axis]);
        sink.u32(uint32_t(part.at_s.size()));
        for (size_t key = 0; key < part.at_s.size(); ++key) {
            const Pose& pose = part.poses[key];
            for (float number : {part.at_s[key], pose.turn.w, pose.turn.x, pose.turn.y, pose.turn.z}) sink.f32(number);
            for (int axis = 0; axis < 3; ++axis) sink.f32(pose.move_m[axis]);
        }
    }
    return std::move(sink.bytes);
}

Fault parts_of_bytes(std::span<const std::byte> bytes, uint32_t count, std::vector<Part>& parts) {
    Scan scan(bytes);
    parts.clear();
    for (uint32_t i = 0; i < count; ++i)
        if (!take_part(scan, parts.emplace_back()))
            return {14, fmt::format("part {} is cut short, or its name is not printable", i)};
    if (scan.rest() > 0) return {14, fmt::format("there are {} bytes after its parts", scan.rest())};
    return {};
}

std::vector<std::byte> bytes_of_visibility(const std::vector<Visibility>& visibility) {
    Sink sink;
    for (const Visibility& v : visibility) {
        for (uint32_t number : {uint32_t(v.lookup), v.width, v.height, v.depth}) sink.u32(number);
        sink.f32(v.period_m);
        sink.add(std::as_bytes(std::span(v.values)));
    }
    return std::move(sink.bytes);
}

Fault visibility_of_bytes(std::span<const std::byte> bytes, uint32_t count, std::vector<Visibility>& visibility) {
    Scan scan(bytes);
    for (uint32_t i = 0; i < count; ++i) {
        Visibility v;
        v.lookup = Visibility::Lookup(scan.u32());
        v.width = scan.u32(), v.height = scan.u32(), v.depth = scan.u32();
        v.period_m = scan.f32();
        if (!scan.is_whole()) return {18, fmt::format("entry {} is cut short", i)};
        if (Fault fault = fault_of_visibility(v)) return {fault.rule, fmt::format("entry {} {}", i, fault.text)};
        std::span<const std::byte> values = scan.take(uint64_t(v.width) * v.height * v.depth);
        if (!scan.is_whole()) return {18, fmt::format("entry {} is cut short", i)};
        for (std::byte value : values) v.values.push_back(uint8_t(value));
        visibility.push_back(std::move(v));
    }
    if (scan.rest() > 0) return {18, fmt::format("there are {} bytes after its entries", scan.rest())};
    return {};
}

}  // namespace overlook::discrete
