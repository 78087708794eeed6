// A TIFF file made tag by tag, so that a test can break any of them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace overlook::test {

class TiffMaker {
  public:
    explicit TiffMaker(bool is_big_endian = false, bool is_big_tiff = false)
        : is_big_endian_(is_big_endian), is_big_tiff_(is_big_tiff) {}

    TiffMaker& shorts(uint16_t tag, const std::vector<uint16_t>& values) { return set(tag, 3, values); }
    TiffMaker& longs(uint16_t tag, const std::vector<uint32_t>& values) { return set(tag, 4, values); }
    TiffMaker& doubles(uint16_t tag, const std::vector<double>& values) {
        std::vector<uint64_t> bits;
        for (const double value : values) bits.push_back(std::bit_cast<uint64_t>(value));
        return set(tag, 12, bits);
    }
    TiffMaker& text(uint16_t tag, const std::string& value) {
        tags_[tag] = {2, value.size() + 1, std::string(value.c_str(), value.size() + 1)};
        return *this;
    }
    TiffMaker& without(uint16_t tag) {
        tags_.erase(tag);
        return *this;
    }
    // Sets what a raster of one channel needs: one uncompressed strip, its samples of type T at the end of the file.
    template <class T>
    TiffMaker& raster(uint32_t width, uint32_t height, const std::vector<T>& samples) {
        const bool is_real = std::is_floating_point_v<T>;
        longs(256, {width})
            .longs(257, {height})
            .shorts(258, {uint16_t(8 * sizeof(T))})
            .shorts(259, {1})
            .shorts(262, {1})
            .shorts(277, {1});
        longs(278, {height}).shorts(339, {uint16_t(is_real ? 3 : std::is_signed_v<T> ? 2 : 1)});
        longs(279, {uint32_t(samples.size() * sizeof(T))}).longs(273, {0});
        pixels_.clear();
        for (const T sample : samples) pixels_ += number(sample);
        return *this;
    }
    // Keys of GeoKeyDirectory, in rising order of id.
    TiffMaker& keys(const std::vector<std::pair<uint16_t, uint16_t>>& keys) {
        std::vector<uint16_t> words{1, 1, 0, uint16_t(keys.size())};
        for (const auto& [id, value] : keys) words.insert(words.end(), {id, 0, 1, value});
        return shorts(34735, words);
    }
    // The grid of a north-up raster: place of the first corner (or first sample, if the raster says pixel-is-point), steps.
    TiffMaker& grid(double x, double y, double step_x, double step_y) {
        return doubles(33550, {step_x, step_y, 0}).doubles(33922, {0, 0, 0, x, y, 0});
    }

    std::string bytes() const {
        const size_t offset_bytes = is_big_tiff_ ? 8 : 4, head = is_big_tiff_ ? 16 : 8, count_bytes = is_big_tiff_ ? 8 : 2;
        const size_t table = head + count_bytes + tags_.size() * (4 + 2 * offset_bytes) + offset_bytes;
        size_t values_end = table;
        for (const auto& [tag, entry] : tags_) values_end += entry.bytes.size() > offset_bytes ? entry.bytes.size() : 0;

        std::string out = is_big_endian_ ? "MM" : "II";
        out += number(uint16_t(is_big_tiff_ ? 43 : 42));
        if (is_big_tiff_) out += number(uint16_t(8)) + number(uint16_t(0));
        out += offset(head) + (is_big_tiff_ ? number(uint64_t(tags_.size())) : number(uint16_t(tags_.size())));
        std::string values;
        for (const auto& [tag, entry] : tags_) {
            std::string bytes = entry.bytes;
            if (tag == 273 && bytes == number(uint32_t(0))) bytes = number(uint32_t(values_end));
            out += number(tag) + number(entry.type) + offset(entry.count);
            if (bytes.size() <= offset_bytes) {
                out += bytes + std::string(offset_bytes - bytes.size(), '\0');
            } else {
                out += offset(table + values.size());
                values += bytes;
            }
        }
        return out + offset(0) + values + pixels_;
    }

  private:
    struct Entry {
        uint16_t type = 0;
        uint64_t count = 0;
        std::string bytes;
    };

    template <class T>
    std::string number(T value) const {
        std::string text(sizeof(T), '\0');
        std::memcpy(text.data(), &value, sizeof(T));
        return is_big_endian_ ? std::string(text.rbegin(), text.rend()) : text;
    }
    std::string offset(uint64_t value) const { return is_big_tiff_ ? number(value) : number(uint32_t(value)); }
    template <class T>
    TiffMaker& set(uint16_t tag, uint16_t type, const std::vector<T>& values) {
        std::string bytes;
        for (const T value : values) bytes += number(value);
        tags_[tag] = {type, values.size(), bytes};
        return *this;
    }

    bool is_big_endian_;
    bool is_big_tiff_;
    std::map<uint16_t, Entry> tags_;
    std::string pixels_;
};

}  // namespace overlook::test
