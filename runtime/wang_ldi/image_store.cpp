#include "runtime/wang_ldi/image_store.h"

#include <algorithm>
#include <cstdlib>

namespace overlook::wang_ldi {
namespace {

// Which of a ladder's rungs shows images of a level; -1 if none does.
int rung_of_level(const Ladder& ladder, int64_t level) {
    for (size_t r = 0; r < ladder.rungs.size(); ++r)
        if (ladder.rungs[r].stage == Stage::ldi && int64_t(ladder.rungs[r].level) == level) return int(r);
    return -1;
}

// Near things first, and of these what shows most.
float priority_of(const Item& item, const Shown& shown) {
    double share = double(shown.by_rung.share()) * shown.by_direction.share() / (double(kWhole) * kWhole);
    return float((0.5 + 0.5 * share) / std::max(item.distance_m, 1e-3));
}

constexpr float kAhead = 1e-6f;  // of the priority of what is in view

}  // namespace

StoredImage StoredImage::of(Ldi ldi) {
    StoredImage made;
    made.prepared = PreparedLdi::of(ldi), made.ldi = std::move(ldi);
    return made;
}

uint64_t bytes_of(const ImageSet& set, uint32_t level, const Entry& entry) {
    uint64_t side = set.levels[level].side_px, samples = entry.sample_count, padded = samples + PreparedLdi::kPadding;
    uint64_t each = sizeof(uint16_t) + sizeof(uint8_t) + (set.has_normals ? 2 : 0) + (set.has_splats ? 1 : 0);
    uint64_t ldi = sizeof(uint32_t) * (side * side + 1) + each * samples + 3 * uint64_t(entry.colour_count);
    bool has_splats = set.has_splats && samples > 0;
    uint64_t prepared = 4 * (side * side + 1 + padded + entry.colour_count) + padded + (has_splats ? padded : 0) + 4 * side;
    return sizeof(StoredImage) + ldi + prepared;
}

ImageStore::ImageStore(const ImageReader& images)
    : reader_(&images), decoded_(images.entries().size()), images_(images.entries().size()) {}

Result<std::unique_ptr<ImageStore>> ImageStore::open(const std::string& name, const ImageReader& images,
                                                     const stream::Settings& settings) {
    std::unique_ptr<ImageStore> made(new ImageStore(images));
    const ImageSet& set = images.set();
    stream::Source source;
    std::vector<uint32_t> coarsest;
    for (uint64_t i = 0; i < set.ldi_count(); ++i) {
        uint32_t level = which_of(set, i).level;
        source.decoded_bytes.push_back(wang_ldi::bytes_of(set, level, images.entries()[size_t(i)]));
        if (level + 1 == set.levels.size()) coarsest.push_back(uint32_t(i));
    }
    made->bytes_ = source.decoded_bytes;
    source.need_begin.assign(source.decoded_bytes.size() + 1, 0);
    source.keeps_blocks = true;
    ImageStore* store = made.get();
    source.decode = [store](uint32_t block, std::span<const std::span<const std::byte>>) -> Result<stream::Bytes> {
        Result<Ldi> ldi = store->reader_->read(block);
        if (!ldi) return tl::unexpected(ldi.error());
        store->decoded_[block] = std::make_unique<StoredImage>(StoredImage::of(std::move(*ldi)));
        return stream::Bytes();
    };
    Result<std::unique_ptr<stream::Stream>> stream = stream::Stream::open(name, std::move(source), settings);
    if (!stream) return tl::unexpected(stream.error());
    made->stream_ = std::move(*stream);
    if (Result<void> kept = made->stream_->keep(coarsest); !kept) return tl::unexpected(kept.error());
    for (uint32_t block : coarsest) made->images_[block] = std::move(made->decoded_[block]);
    return made;
}

const std::vector<Error>& ImageStore::begin_frame() {
    const stream::Stream::Changes& changes = stream_->begin_frame();
    for (uint32_t block : changes.dropped) images_[block].reset();
    for (uint32_t block : changes.arrived) images_[block] = std::move(decoded_[block]);
    faults_ = changes.faults;
    return faults_;
}

ImageStore::Taken ImageStore::take(const Field& field, FieldList& list) {
    Taken taken;
    for (Item& item : list.items) {
        for (uint32_t s = item.first_shown; s < item.first_shown + item.shown_count; ++s) {
            Shown& shown = list.shown[s];
            if (field.ladder().rungs[shown.rung].stage != Stage::ldi) continue;
            ++taken.images;
            uint64_t wanted = field.image_of(item, shown);
            if (is_there(wanted)) {
                stream_->use(uint32_t(wanted));
                continue;
            }
            stream_->ask(uint32_t(wanted), priority_of(item, shown));
            bool is_stood_in = stand_in(field, item, shown);
            (is_stood_in ? taken.stand_ins : taken.missing)++;
        }
    }
    return taken;
}

// The finer level and the coarser ones of its direction, then the same of ever farther directions.
bool ImageStore::stand_in(const Field& field, Item& item, Shown& shown) {
    const ImageSet& set = reader_->set();
    int64_t level = field.ladder().rungs[shown.rung].level, levels = int64_t(set.levels.size());
    int64_t directions = set.direction_count;
    for (int64_t turn = 0; turn <= directions / 2; ++turn) {
        for (int64_t step = turn == 0 ? -1 : 0; level + step < levels; ++step) {
            for (int64_t side : {turn, -turn}) {
                Shown other = shown;
                int rung = rung_of_level(field.ladder(), level + step);
                if (rung < 0) continue;
                other.rung = uint32_t(rung);
                other.direction = uint32_t((int64_t(shown.direction) + side + directions) % directions);
                uint64_t index = field.image_of(item, other);
                if (!is_there(index)) continue;
                stream_->use(uint32_t(index));
                shown = other;
                item.coarser_px = std::min(item.coarser_px, set.levels[size_t(level + step)].side_px);
                return true;
            }
        }
    }
    return false;
}

void ImageStore::look_ahead(const Field& field, const FieldList& list) {
    for (const Item& item : list.items)
        for (const Shown& shown : list.shown_of(item)) {
            if (field.ladder().rungs[shown.rung].stage != Stage::ldi) continue;
            uint64_t index = field.image_of(item, shown);
            if (!is_there(index)) stream_->ask(uint32_t(index), kAhead * priority_of(item, shown));
        }
}

void ImageStore::end_frame() {
    stream_->end_frame();
}

}  // namespace overlook::wang_ldi
