// The sections of Wang ground as bytes, and back.
#include "formats/wang_ground.h"

#include <algorithm>
#include <new>

#include "formats/little_endian.h"
#include "formats/wang_layout.h"

namespace overlook::wang_ldi {
namespace {

using container::Reader;

class Sink {
  public:
    template <typename T>
    void add(T value) {
        bytes.resize(bytes.size() + sizeof(T));
        store_le<T>(bytes, bytes.size() - sizeof(T), value);
    }
    void f32(float value) { add(std::bit_cast<uint32_t>(value)); }
    void text(const std::string& value) {
        add(uint32_t(value.size()));
        for (char c : value) bytes.push_back(std::byte(c));
    }
    std::vector<std::byte> bytes;
};

// Bytes from front to back; what is missing is never read, and says so.
class Scan {
  public:
    explicit Scan(std::span<const std::byte> bytes) : bytes_(bytes) {}
    template <typename T>
    T take() {
        is_whole_ = is_whole_ && sizeof(T) <= bytes_.size();
        if (!is_whole_) return 0;
        T value = load_le<T>(bytes_, 0);
        bytes_ = bytes_.subspan(sizeof(T));
        return value;
    }
    float f32() { return std::bit_cast<float>(take<uint32_t>()); }
    std::string text(uint32_t size) {
        is_whole_ = is_whole_ && size <= bytes_.size();
        if (!is_whole_) return "";
        std::string value(reinterpret_cast<const char*>(bytes_.data()), size);
        bytes_ = bytes_.subspan(size);
        return value;
    }
    bool is_whole() const { return is_whole_; }
    uint64_t rest() const { return bytes_.size(); }

  private:
    std::span<const std::byte> bytes_;
    bool is_whole_ = true;
};

bool is_name(const std::string& text) {
    return text.size() <= kNameBytesMax &&
           std::none_of(text.begin(), text.end(), [](char c) { return uint8_t(c) < ' ' || uint8_t(c) == 127; });
}

Fault take_models(Scan& scan, uint32_t count, Planting& planting) {
    for (uint32_t m = 0; m < count; ++m) {
        auto size = scan.take<uint32_t>();
        Model model;
        if (size <= kNameBytesMax) model.name = scan.text(size);
        model.tight_radius_m = scan.f32(), model.packing_radius_m = scan.f32();
        if (!scan.is_whole() || size > kNameBytesMax || !is_name(model.name))
            return {6, fmt::format("model {} is cut short, or its name is not printable", m)};
        planting.models.push_back(std::move(model));
    }
    return {};
}

Fault take_tile(Scan& scan, std::vector<Planted>& tile, size_t t) {
    auto count = scan.take<uint32_t>();
    if (!scan.is_whole() || uint64_t(count) * kPlantedBytes > scan.rest()) return {6, fmt::format("tile {} is cut short", t)};
    for (uint32_t i = 0; i < count; ++i) {
        Planted object;
        object.model = scan.take<uint32_t>();
        for (float* number : {&object.x_m, &object.y_m, &object.turn_rad, &object.scale}) *number = scan.f32();
        object.owner = Owner(std::min(scan.take<uint32_t>(), 255u));
        tile.push_back(object);
    }
    return {};
}

Fault fault_of(const PlantedTiles& ground) {
    if (Fault fault = fault_of_counts(ground.set)) return fault;
    if (Fault fault = fault_of_set(ground.set)) return fault;
    bool has_names = std::all_of(ground.planting.models.begin(), ground.planting.models.end(),
                                 [](const Model& model) { return is_name(model.name); });
    if (!has_names || ground.planting.models.size() > kMostModels) return {6, "too many models, or one of an unprintable name"};
    if (uint64_t bytes = byte_count_of_planting(ground.planting); bytes > kPlantingBytesMax)
        return {6, fmt::format("WPLT is of {} bytes", bytes)};
    if (Fault fault = fault_of_models(ground.planting)) return fault;
    return fault_of_objects(ground.set, ground.planting);
}

tl::unexpected<Error> broken(const Reader& file, const Fault& fault) {
    return bad_input("{}: W{}: {}", file.name(), fault.rule, fault.text);
}

Result<PlantedTiles> read_whole(const Reader& file) {
    const container::Section *tiles = file.find(kTilesTag), *planting = file.find(kPlantingTag);
    if (file.kind() != kKind || !tiles || !planting)
        return broken(file, {1, fmt::format("is no ground of Wang tiles (its kind is {})", container::tag_text(file.kind()))});
    if (auto known = file.require_known(kKnownTags); !known) return tl::unexpected(known.error());
    constexpr uint64_t kTilesBytesMax = kTilesHeadBytes + kMostColours * 8 + kMostTiles * 4;
    if (tiles->raw_bytes > kTilesBytesMax) return broken(file, {2, fmt::format("WTIL is of {} bytes", tiles->raw_bytes)});
    if (planting->raw_bytes > kPlantingBytesMax)
        return broken(file, {6, fmt::format("WPLT is of {} bytes", planting->raw_bytes)});
    PlantedTiles ground;
    auto bytes = file.read(*tiles, kTilesBytesMax);
    if (!bytes) return tl::unexpected(bytes.error());
    if (Fault fault = tiles_of_bytes(*bytes, ground.set)) return broken(file, fault);
    if (Fault fault = fault_of_set(ground.set)) return broken(file, fault);
    bytes = file.read(*planting, kPlantingBytesMax);
    if (!bytes) return tl::unexpected(bytes.error());
    if (Fault fault = planting_of_bytes(*bytes, ground.planting)) return broken(file, fault);
    if (Fault fault = fault_of_models(ground.planting)) return broken(file, fault);
    if (Fault fault = fault_of_objects(ground.set, ground.planting)) return broken(file, fault);
    return ground;
}

}  // namespace

std::vector<std::byte> bytes_of_tiles(const TileSet& set) {
    Sink sink;
    for (size_t count : {set.horizontal.size(), set.vertical.size(), set.corner_density.size(), set.tiles.size()})
        sink.add(uint16_t(count));
    for (float density : set.corner_density) sink.f32(density);
    for (const auto* edges : {&set.horizontal, &set.vertical})
        for (const EdgeColour& colour : *edges) sink.add(colour.low), sink.add(colour.high);
    for (const Tile& tile : set.tiles)
        for (uint8_t colour : {tile.north, tile.east, tile.south, tile.west}) sink.add(colour);
    return std::move(sink.bytes);
}

Fault tiles_of_bytes(std::span<const std::byte> bytes, TileSet& set) {
    Scan scan(bytes);
    set.horizontal.resize(scan.take<uint16_t>()), set.vertical.resize(scan.take<uint16_t>());
    set.corner_density.resize(scan.take<uint16_t>()), set.tiles.resize(scan.take<uint16_t>());
    if (!scan.is_whole()) return {2, fmt::format("has {} bytes", bytes.size())};
    if (Fault fault = fault_of_counts(set)) return fault;
    for (float& density : set.corner_density) density = scan.f32();
    for (auto* edges : {&set.horizontal, &set.vertical})
        for (EdgeColour& colour : *edges) colour.low = scan.take<uint8_t>(), colour.high = scan.take<uint8_t>();
    for (Tile& tile : set.tiles)
        for (uint8_t* colour : {&tile.north, &tile.east, &tile.south, &tile.west}) *colour = scan.take<uint8_t>();
    if (!scan.is_whole() || scan.rest() > 0)
        return {2, fmt::format("WTIL has {} bytes for {} tiles, {}", bytes.size(), set.tiles.size(),
                               scan.is_whole() ? "some too many" : "which is too few")};
    return {};
}

std::vector<std::byte> bytes_of_planting(const Planting& planting) {
    Sink sink;
    sink.add(std::bit_cast<uint64_t>(planting.tile_size_m));
    sink.add(uint32_t(planting.models.size())), sink.add(uint32_t(planting.tiles.size()));
    for (const Model& model : planting.models)
        sink.text(model.name), sink.f32(model.tight_radius_m), sink.f32(model.packing_radius_m);
    for (const auto& tile : planting.tiles) {
        sink.add(uint32_t(tile.size()));
        for (const Planted& object : tile) {
            sink.add(object.model);
            for (float number : {object.x_m, object.y_m, object.turn_rad, object.scale}) sink.f32(number);
            sink.add(uint32_t(object.owner));
        }
    }
    return std::move(sink.bytes);
}

uint64_t byte_count_of_planting(const Planting& planting) {
    uint64_t bytes = 16;
    for (const Model& model : planting.models) bytes += 12 + model.name.size();
    for (const auto& tile : planting.tiles) bytes += 4 + tile.size() * kPlantedBytes;
    return bytes;
}

Fault planting_of_bytes(std::span<const std::byte> bytes, Planting& planting) {
    Scan scan(bytes);
    planting.tile_size_m = std::bit_cast<double>(scan.take<uint64_t>());
    auto models = scan.take<uint32_t>(), tiles = scan.take<uint32_t>();
    if (!scan.is_whole() || models > kMostModels || tiles > kMostTiles)
        return {6, fmt::format("WPLT has {} bytes, of {} models and {} tiles", bytes.size(), models, tiles)};
    if (Fault fault = take_models(scan, models, planting)) return fault;
    for (uint32_t t = 0; t < tiles; ++t)
        if (Fault fault = take_tile(scan, planting.tiles.emplace_back(), t)) return fault;
    if (scan.rest() > 0) return {6, fmt::format("there are {} bytes after its tiles", scan.rest())};
    return {};
}

Result<void> check_size(const Planting& planting) {
    uint64_t bytes = byte_count_of_planting(planting), objects = 0;
    for (const auto& tile : planting.tiles) objects += tile.size();
    if (bytes <= kPlantingBytesMax) return {};
    return impossible(
        "{} objects of {} models on {} tiles take {} bytes of a file, {} are possible; ask for smaller tiles, fewer of them or "
        "a lower density",
        objects, planting.models.size(), planting.tiles.size(), bytes, kPlantingBytesMax);
}

Result<void> write(container::Writer& writer, const PlantedTiles& ground) {
    if (Fault fault = fault_of(ground))
        return tl::unexpected(Error{Exit::our_bug, fmt::format("ground to write: W{}: {}", fault.rule, fault.text)});
    if (auto ok = writer.add(kTilesTag, container::kMustUnderstand, container::Codec::none, bytes_of_tiles(ground.set)); !ok)
        return ok;
    return writer.add(kPlantingTag, container::kMustUnderstand, container::Codec::zstd, bytes_of_planting(ground.planting));
}

Result<PlantedTiles> read(const Reader& file) {
    try {
        return read_whole(file);
    } catch (const std::bad_alloc&) {
        return impossible("{}: there is not enough memory for this ground", file.name());
    }
}

Result<PlantedTiles> read(const std::string& path) {
    auto file = Reader::open(path);
    if (!file) return tl::unexpected(file.error());
    return read(*file);
}

}  // namespace overlook::wang_ldi
