#include "runtime/caveclod/mesh_stream.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "formats/numbers.h"

namespace overlook::caveclod {
namespace {

// What is planned for a split that nobody has read yet: on average it moves few faces and needs few others.
constexpr uint64_t kPlannedMoves = 10, kPlannedNeeds = 6, kPlannedRecordBytes = 96;
// What saturating spheres and cones, and turning needs about, take a split and a need.
constexpr uint64_t kWorkBytesASplit = 104, kWorkBytesANeed = 8;
// A vertex on the graphics card, with its colour and the room that buffers keep to grow.
constexpr uint64_t kDrawnBytesAVertex = 25;
// The mesh that lacks most takes from one that would lack less than this share of it.
constexpr double kYieldingShare = 0.5;

// Beside the hierarchy and what its reader keeps.
uint64_t working_bytes(uint64_t splits, uint64_t positions, uint64_t faces, uint64_t needs) {
    return MeshState::bytes(faces, positions) + splits * kWorkBytesASplit + needs * kWorkBytesANeed;
}

// The most that a block may take: of the hierarchy and its reader, at work, of the mesh before and after, and drawn.
uint64_t planned_bytes(const BlockFile::Counts& of) {
    uint64_t hierarchy = of.positions * (sizeof(glm::vec3) + 4) + of.vertices * sizeof(RenderVertex) +
                         of.splits * (4 * 7 + sizeof(NormalCone) + 4 * kPlannedNeeds + 8 * kPlannedMoves) +
                         of.faces_at_most * uint64_t(12 + 6 + 4 + 6);
    uint64_t reader = MeshState::bytes(of.faces_at_most, of.positions) + of.positions * sizeof(GridPosition) +
                      of.vertices * sizeof(Steps) + of.splits * 4;
    uint64_t mesh = of.splits * (sizeof(Bounds) + 4 + kPlannedRecordBytes) + of.positions * 5 +
                    of.vertices * (sizeof(PackedVertex) + 4) + (of.splits == 0 ? of.faces_at_most * uint64_t(14) : 0) + 64;
    return hierarchy + reader + working_bytes(of.splits, of.positions, of.faces_at_most, of.splits * kPlannedNeeds) + 2 * mesh +
           of.vertices * kDrawnBytesAVertex;
}

BlockFile::Counts counts_of(const BlockFile& file, uint32_t begin, uint32_t end) {
    BlockFile::Counts sum;
    for (uint32_t block = begin; block < end; ++block) {
        BlockFile::Counts one = file.counts(block);
        sum.splits += one.splits, sum.positions += one.positions, sum.faces_at_most += one.faces_at_most;
        sum.vertices += one.vertices;
    }
    return sum;
}

}  // namespace

struct MeshStream::Part {
    struct Seen {
        const Refinement* refinement;
        const view::Camera* camera;
        const Settings* settings;
    };

    explicit Part(container::Reader opened) : reader(std::move(opened)) {}

    container::Reader reader;
    std::optional<BlockFile> file;
    std::vector<uint32_t> run_end;          // of the file's blocks: what comes as one block of the stream
    uint32_t first_run = 0, run_count = 0;  // in the stream; of those that may come
    std::vector<uint64_t> planned_bytes;    // [run_count]

    // The frames'.
    std::optional<Mesh> mesh;
    std::vector<Mesh::Extent> extents;  // [runs that are there] up to each
    std::vector<uint64_t> held_bytes;   // the same
    std::vector<Seen> seen;             // in this frame
    double missing_px = 0;
    bool is_wanted = false;
    uint32_t staying = 0;  // of the runs that are there, those that do not give way to others

    // The worker's while a run is on its way; there is one at most.
    std::unique_ptr<PrefixReader> prefix;
    std::optional<Mesh> arrived;
    uint64_t arrived_bytes = 0;  // of all runs up to the last

    uint32_t there() const { return uint32_t(extents.size()); }
    bool is_yielding() const { return mesh->split_limit() < mesh->split_count(); }
    uint32_t run_begin(uint32_t run) const { return run > 0 ? run_end[run - 1] : 0; }
    // What would be missing with so many runs, 1 at least, as it is seen.
    double px_with(uint32_t runs) const {
        double px = 0;
        for (const Seen& one : seen)
            px = std::max(px,
                          one.refinement->displaced_px(*one.camera, *one.settings, file->missing_error_m(run_end[runs - 1]), 0));
        return px;
    }
    uint64_t held() const {
        uint64_t sum = 0;
        for (uint64_t bytes : held_bytes) sum += bytes;
        return sum;
    }
};

MeshStream::~MeshStream() = default;

const Mesh& MeshStream::mesh(size_t i) const {
    return *parts_[i]->mesh;
}
uint32_t MeshStream::block_count(size_t i) const {
    return parts_[i]->file->block_count();
}
uint32_t MeshStream::resident_block_count(size_t i) const {
    return parts_[i]->run_end[parts_[i]->there() - 1];
}

std::vector<uint32_t> runs_of_blocks(std::span<const uint32_t> split_counts) {
    constexpr uint64_t kShare = 8;
    std::vector<uint32_t> ends;
    uint64_t before = 0, run = 0;
    for (uint32_t block = 0; block < split_counts.size(); ++block) {
        run += split_counts[block];
        if (block > 0 && kShare * run < before && block + 1 < split_counts.size()) continue;
        ends.push_back(block + 1);
        before += std::exchange(run, 0);
    }
    return ends;
}

// The next run of a part, on top of those that are there; from the front where the reader has been given up.
Result<stream::Bytes> MeshStream::decode(Part& part, uint32_t run) {
    uint32_t end = part.run_end[run];
    if (!part.prefix || part.prefix->block_count() > part.run_begin(run))
        part.prefix = std::make_unique<PrefixReader>(*part.file);
    Result<void> read;
    while (read && part.prefix->block_count() < end) read = part.prefix->read_next();
    if (read) read = part.prefix->complete();
    if (!read) {
        part.prefix.reset();
        return tl::unexpected(read.error());
    }
    const Hierarchy& h = part.prefix->hierarchy();
    const BlockFile& file = *part.file;
    Result<Mesh> mesh = Mesh::make(h, {file.face_count(), file.vertex_count(), file.missing_error_m(end)});
    if (!mesh) return tl::unexpected(mesh.error());
    part.arrived_bytes = part.prefix->bytes() + 2 * mesh->bytes().all() + mesh->vertex_count() * kDrawnBytesAVertex +
                         working_bytes(h.split_count(), h.positions_m.size(), h.face_positions.size(), h.needs.size());
    if (part.arrived_bytes > part.held() + part.planned_bytes[run]) {
        part.prefix.reset();
        return impossible("{}: block {} takes {} bytes in memory, {} were planned for", part.reader.name(), end - 1,
                          with_commas(part.arrived_bytes - part.held()), with_commas(part.planned_bytes[run]));
    }
    part.arrived.emplace(std::move(*mesh));
    if (end == file.block_count()) part.prefix.reset();
    return stream::Bytes();
}

stream::Source MeshStream::source_of(const stream::Settings& settings) {
    stream::Source source;
    source.keeps_blocks = true;
    for (const std::unique_ptr<Part>& part : parts_) {
        part->first_run = source.block_count();
        for (uint32_t run = 0; run < part->run_end.size(); ++run) {
            BlockFile::Counts counts = counts_of(*part->file, part->run_begin(run), part->run_end[run]);
            uint64_t bytes = planned_bytes(counts);
            if (run > 0 && bytes > settings.residency_budget_bytes) break;
            if (run > 0) source.needs.push_back(source.block_count() - 1);
            source.need_begin.push_back(uint32_t(source.needs.size()));
            source.decoded_bytes.push_back(bytes);
            source.upload_bytes.push_back(counts.vertices * (sizeof(PackedVertex) + sizeof(uint32_t)));
            part->planned_bytes.push_back(bytes);
        }
        part->run_count = uint32_t(part->planned_bytes.size());
    }
    source.decode = [this](uint32_t block, std::span<const std::span<const std::byte>>) {
        Part& part = part_of(block);
        return decode(part, block - part.first_run);
    };
    return source;
}

MeshStream::Part& MeshStream::part_of(uint32_t stream_block) {
    auto after = std::upper_bound(parts_.begin(), parts_.end(), stream_block,
                                  [](uint32_t block, const std::unique_ptr<Part>& part) { return block < part->first_run; });
    return **(after - 1);
}

Result<std::unique_ptr<MeshStream>> MeshStream::open(std::vector<container::Reader> files, const stream::Settings& settings) {
    assert(!files.empty());
    std::unique_ptr<MeshStream> made(new MeshStream());
    made->budget_bytes_ = settings.residency_budget_bytes;
    for (container::Reader& file : files) {
        made->parts_.push_back(std::make_unique<Part>(std::move(file)));
        Part& part = *made->parts_.back();
        Result<BlockFile> opened = BlockFile::open(part.reader);
        if (!opened) return tl::unexpected(opened.error());
        part.file.emplace(std::move(*opened));
        std::vector<uint32_t> split_counts;
        for (uint32_t block = 0; block < part.file->block_count(); ++block)
            split_counts.push_back(part.file->counts(block).splits);
        part.run_end = runs_of_blocks(split_counts);
    }
    std::string name = made->parts_.front()->reader.name();
    if (files.size() > 1) name += fmt::format(" and {} more", files.size() - 1);
    Result<std::unique_ptr<stream::Stream>> stream = stream::Stream::open(name, made->source_of(settings), settings);
    if (!stream) return tl::unexpected(stream.error());
    made->stream_ = std::move(*stream);
    std::vector<uint32_t> coarsest;
    std::vector<std::vector<Surface>> surfaces;
    for (const std::unique_ptr<Part>& part : made->parts_) {
        coarsest.push_back(part->first_run);
        surfaces.push_back(part->file->take_surfaces());
    }
    if (Result<void> kept = made->stream_->keep(coarsest); !kept) return tl::unexpected(kept.error());
    for (size_t i = 0; i < files.size(); ++i) {
        made->take_arrived(*made->parts_[i]);
        made->parts_[i]->mesh->set_surfaces(std::move(surfaces[i]));
    }
    return made;
}

void MeshStream::take_arrived(Part& part) {
    if (part.mesh)
        part.mesh->grow(std::move(*part.arrived));
    else
        part.mesh.emplace(std::move(*part.arrived));
    part.arrived.reset();
    uint64_t before = part.held(), bytes = part.arrived_bytes > before ? part.arrived_bytes - before : 1;
    stream_->set_held_bytes(part.first_run + part.there(), bytes);
    part.extents.push_back(part.mesh->extent());
    part.held_bytes.push_back(bytes);
}

std::span<const Error> MeshStream::begin_frame() {
    const stream::Stream::Changes& changes = stream_->begin_frame();
    for (uint32_t block : changes.arrived) take_arrived(part_of(block));
    for (const std::unique_ptr<Part>& part : parts_) part->seen.clear(), part->missing_px = 0, part->is_wanted = false;
    return changes.faults;
}

void MeshStream::take_note(size_t i, const Refinement& refinement, const view::Camera& camera, const Settings& settings,
                           double missing_px) {
    Part& part = *parts_[i];
    assert(&refinement.mesh() == &*part.mesh);
    part.seen.push_back({&refinement, &camera, &settings});
    part.missing_px = std::max(part.missing_px, missing_px);
    part.is_wanted = part.is_wanted || missing_px > settings.error_px;
    // The run of the last split that is applied, and with it all before.
    uint32_t end = refinement.split_end(), run = 0;
    while (end > part.extents[run].split_count) ++run;
    stream_->use(part.first_run + run);
}

// Each part's next run: what is wanted by how much it lacks, and others as far as there is room without dropping any.
void MeshStream::ask() {
    uint64_t asked_bytes = stream_->counts().resident_bytes + stream_->counts().on_the_way_bytes;
    for (bool is_wanted : {true, false}) {
        for (const std::unique_ptr<Part>& part : parts_) {
            if (part->is_wanted != is_wanted || part->there() == part->run_count || part->is_yielding()) continue;
            asked_bytes += part->planned_bytes[part->there()];
            if (is_wanted || asked_bytes <= budget_bytes_)
                stream_->ask(part->first_run + part->there(), is_wanted ? float(part->missing_px) : 0);
        }
    }
}

// Of what has found no room, who lacks most may have that of the last runs of others, those first that show it least. Nobody
// yields anything unless all together is enough.
void MeshStream::give_way() {
    Part* lacking = nullptr;
    for (const std::unique_ptr<Part>& part : parts_) {
        part->mesh->set_split_limit(part->mesh->split_count());
        part->staying = part->there();
        if (part->is_wanted && part->there() < part->run_count && (!lacking || part->missing_px > lacking->missing_px))
            lacking = part.get();
    }
    if (lacking == nullptr || stream_->counts().refused_count == 0) return;
    uint64_t held = stream_->counts().resident_bytes + stream_->counts().on_the_way_bytes;
    uint64_t wanted = held + lacking->planned_bytes[lacking->there()];
    while (wanted > budget_bytes_) {
        Part* yielding = nullptr;
        double least_px = kYieldingShare * lacking->missing_px;
        for (const std::unique_ptr<Part>& part : parts_) {
            if (part.get() == lacking || part->staying < 2) continue;
            double px = part->px_with(part->staying - 1);
            if (px < least_px) yielding = part.get(), least_px = px;
        }
        if (yielding == nullptr) return;
        wanted -= std::min(wanted, yielding->held_bytes[--yielding->staying]);
    }
    for (const std::unique_ptr<Part>& part : parts_) part->mesh->set_split_limit(part->extents[part->staying - 1].split_count);
}

void MeshStream::end_frame() {
    ask();
    stream_->end_frame();
    for (const std::unique_ptr<Part>& part : parts_) drop(*part);
    give_way();
}

void MeshStream::drop(Part& part) {
    while (!stream_->is_resident(part.first_run + part.there() - 1)) part.extents.pop_back(), part.held_bytes.pop_back();
    if (part.extents.back().split_count == part.mesh->split_count()) return;
    part.mesh->shrink(part.extents.back(), part.file->missing_error_m(part.run_end[part.there() - 1]));
    part.prefix.reset();
}

}  // namespace overlook::caveclod
