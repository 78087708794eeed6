// A terrain of which a part is in memory, in the player.

#include <algorithm>
#include <cassert>
#include <cmath>

#include "runtime/gl/timer.h"
#include "runtime/player/draw_cut.h"
#include "runtime/player/flight.h"
#include "runtime/player/subject.h"
#include "runtime/terrain/near_plane.h"
#include "runtime/terrain/refine_tiles.h"

namespace overlook::player {
namespace {

class StreamedSubject : public Subject {
  public:
    StreamedSubject(std::unique_ptr<terrain::Tiles> tiles, const Streaming& streaming)
        : tiles_(std::move(tiles)), refiner_(*tiles_), streaming_(streaming) {}

    Result<void> upload(const gl::SecondContextMaker&) override {
        Result<terrain::Drawing> drawing = terrain::Drawing::make(*tiles_);
        if (!drawing) return tl::unexpected(drawing.error());
        drawing_.emplace(std::move(*drawing));
        return {};
    }

    view::Camera overview(uint32_t width_px, uint32_t height_px) const override {
        auto ground = [&](double x_m, double y_m) { return height_m(x_m, y_m); };
        double highest_m = double(terrain::height_range_of(head(), tiles_->file().whole()).high_m);
        return player::overview(head(), tiles_->file().mean_height_m(), highest_m, ground, width_px, height_px);
    }
    Thing thing() const override { return Thing::terrain; }
    double near_m() const override { return std::min(0.5, 0.25 * step_m()); }
    bool has_one_method() const override { return true; }

    // Where the finest samples are not there, the highest that they can be.
    std::optional<double> height_m(double x_m, double y_m) const override {
        double column = x_m / head().frame.metres_per_column, row = -y_m / head().frame.metres_per_row;
        const terrain::Shape& shape = head().shape;
        if (!(column >= 0 && row >= 0 && column <= shape.width - 1 && row <= shape.height - 1)) return std::nullopt;
        uint32_t left = std::min(uint32_t(column), shape.width - 2), top = std::min(uint32_t(row), shape.height - 2);
        std::optional<double> highest;
        for (uint32_t corner = 0; corner < 4; ++corner) {
            std::optional<int32_t> steps = tiles_->height(left + corner % 2, top + corner / 2);
            if (!steps) {
                terrain::HeightRange range = tiles_->range_round(left, top);
                return range.is_empty() ? std::nullopt : std::optional(double(range.high_m));
            }
            if (*steps == terrain::kVoid) return std::nullopt;
            double height = head().height_offset_m + head().height_step_m * *steps;
            highest = std::max(highest.value_or(height), height);
        }
        return highest;
    }
    double distance_m(const glm::dvec3& place_m) const override {
        double x_m = std::clamp(place_m.x, 0.0, head().frame.metres_per_column * (head().shape.width - 1));
        double y_m = std::clamp(place_m.y, -head().frame.metres_per_row * (head().shape.height - 1), 0.0);
        return std::hypot(place_m.z - height_m(x_m, y_m).value_or(head().height_offset_m), place_m.x - x_m, place_m.y - y_m);
    }
    double step_m() const override { return std::min(head().frame.metres_per_column, head().frame.metres_per_row); }
    double least_speed_m_s() const override { return 4; }

    Result<FrameRecord> draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style) override {
        assert(drawing_.has_value() && style.method == Method::terrain);
        FrameRecord record;
        record.asked_error_px = style.error_px;
        StreamRecord& stream = record.stream.emplace();
        bool waits = streaming_.waits;
        uint64_t streamed_bytes = 0;
        view::Camera local;
        gl::Timer refining;
        do {
            const stream::Stream::Changes& changes = tiles_->begin_frame();
            for (uint32_t tile : changes.arrived) drawing_->take_tile(*tiles_, tile);
            stream.faults.insert(stream.faults.end(), changes.faults.begin(), changes.faults.end());
            if (waits && !stream.faults.empty()) return tl::unexpected(stream.faults.front());
            local = terrain::with_clear_near_plane(*tiles_, camera);
            refiner_.cut_by_pixels(local, style.error_px, cut_, style.morph);
            tiles_->end_frame();
            streamed_bytes += tiles_->counts().uploaded_bytes;
        } while (waits && !tiles_->is_settled());
        record.refine_ms = refining.elapsed_ms();

        draw_cut(*drawing_, target, cut_, local, style.look, record);
        stream.counts = tiles_->counts();
        stream.counts.uploaded_bytes = streamed_bytes;
        stream.budget_bytes = streaming_.settings.residency_budget_bytes;
        stream.stopped_count = cut_.stopped_count;
        return record;
    }

  private:
    const terrain::Terrain& head() const { return tiles_->head(); }

    std::unique_ptr<terrain::Tiles> tiles_;
    terrain::TileRefiner refiner_;
    Streaming streaming_;
    std::optional<terrain::Drawing> drawing_;
    terrain::Cut cut_;
};

}  // namespace

Result<std::unique_ptr<Subject>> read_streamed_terrain(container::Reader file, const Streaming& streaming) {
    Result<std::unique_ptr<terrain::Tiles>> tiles = terrain::Tiles::open(std::move(file), streaming.settings);
    if (!tiles) return tl::unexpected(tiles.error());
    return std::make_unique<StreamedSubject>(std::move(*tiles), streaming);
}

}  // namespace overlook::player
