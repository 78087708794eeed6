// Baked files: written, mapped and checked, read whole; and their blocks by themselves, without checksums and compression.

#include <filesystem>

#include "formats/container.h"
#include "formats/terrain_blocks.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/inputs.h"
#include "tests/bench/work.h"

namespace overlook::bench {
namespace {

constexpr double kTerrainBytes = 5.4;  // a sample in memory: 4 of height, 1.4 of codes

Result<uint64_t> write_to(const std::string& path, const terrain::Terrain& terrain) {
    auto writer = container::Writer::create(path, terrain::kKind);
    if (!writer) return tl::unexpected(writer.error());
    if (auto written = terrain::write(*writer, terrain); !written) return tl::unexpected(written.error());
    return writer->commit();
}

// The landscape in a file, as long as this lives.
class BakedFile {
  public:
    BakedFile(benchmark::State& state, std::string path, const Landscape& land) : path_(std::move(path)) {
        Result<uint64_t> written = write_to(path_, land.terrain);
        if (!written) state.SkipWithError(written.error().message.c_str());
        bytes_ = written ? double(*written) : 0;
    }
    ~BakedFile() { std::filesystem::remove(path_); }
    BakedFile(const BakedFile&) = delete;
    const std::string& path() const { return path_; }
    double bytes() const { return bytes_; }
    explicit operator bool() const { return bytes_ > 0; }

  private:
    std::string path_;
    double bytes_ = 0;
};

void write_terrain(benchmark::State& state, const Landscape& land, const std::string& path) {
    double samples = double(land.terrain.heights.size());
    BakedFile file(state, path, land);
    if (!file) return;
    repeat(state, [&] {
        if (Result<uint64_t> written = write_to(path, land.terrain); !written)
            state.SkipWithError(written.error().message.c_str());
        return Work{samples, "samples", samples * kTerrainBytes + file.bytes(), file.bytes() / samples};
    });
}

void read_terrain(benchmark::State& state, const Landscape& land, const std::string& path) {
    double samples = double(land.terrain.heights.size());
    BakedFile file(state, path, land);
    if (!file) return;
    repeat(state, [&] {
        Result<terrain::Terrain> read = terrain::read(path);
        if (!read) state.SkipWithError(read.error().message.c_str());
        benchmark::DoNotOptimize(read);
        return Work{samples, "samples", samples * kTerrainBytes + file.bytes(), file.bytes() / samples};
    });
}

// Opening (header, table) and the checksum of every section.
void read_container(benchmark::State& state, const Landscape& land, const std::string& path) {
    BakedFile file(state, path, land);
    if (!file) return;
    repeat(state, [&] {
        Result<container::Reader> reader = container::Reader::open(path);
        if (!reader) state.SkipWithError(reader.error().message.c_str());
        if (!reader) return Work{};
        double bytes = 0;
        for (const container::Section& section : reader->sections()) {
            if (auto checked = reader->check(section); !checked) state.SkipWithError(checked.error().message.c_str());
            bytes += double(reader->stored(section).size());
        }
        return Work{bytes, "bytes", bytes};
    });
}

void decode_blocks(benchmark::State& state, const Landscape& land) {
    std::vector<terrain::Block> blocks = terrain::blocks_of(land.terrain.shape);
    std::vector<std::vector<std::byte>> packed;
    double samples = double(land.terrain.heights.size()), packed_bytes = 0;
    for (const terrain::Block& block : blocks) {
        packed.push_back(terrain::pack_block(land.terrain, block));
        packed_bytes += double(packed.back().size());
    }
    terrain::Terrain decoded = land.terrain;
    repeat(state, [&] {
        for (size_t i = 0; i < blocks.size(); ++i) {
            if (const char* wrong = terrain::unpack_block(packed[i], blocks[i], decoded)) state.SkipWithError(wrong);
        }
        return Work{samples, "samples", packed_bytes + samples * kTerrainBytes, packed_bytes / samples};
    });
    if (decoded.heights != land.terrain.heights) state.SkipWithError("the blocks did not give the heights back");
}

}  // namespace

void add_files(const std::string& name, const std::string& folder) {
    std::string path = folder + "/bench.ovl";
    auto in_file = [path](void (*body)(benchmark::State&, const Landscape&, const std::string&)) {
        return [=](benchmark::State& state, const Landscape& land) { body(state, land, path); };
    };
    add("write_terrain", name, with(name, in_file(write_terrain)));
    add("read_terrain", name, with(name, in_file(read_terrain)));
    add("read_container", name, with(name, in_file(read_container)));
    add("decode_blocks", name, with(name, decode_blocks));
}

}  // namespace overlook::bench
