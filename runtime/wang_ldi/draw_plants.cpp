#include "runtime/wang_ldi/draw_plants.h"

#include <algorithm>

namespace overlook::wang_ldi {
namespace {

// Items of one level stand one after the other.
discrete::FrameList listed(const discrete::ChainFacts& facts, const PlantPlaces& places, const view::Camera& camera,
                           double error_px) {
    discrete::SelectSettings settings;
    settings.error_px = error_px > 0 ? error_px : 1;
    discrete::Selector selector(facts, settings, camera);
    discrete::FrameList list;
    for (uint32_t p = 0; p < places.placements.size(); ++p) {
        if (!selector.is_in_view(places.placements[p])) continue;
        uint32_t level = error_px > 0 ? selector.wanted(places.placements[p]) : 0;
        discrete::Show show = places.shares[p] < 1 ? discrete::Show::dithered_in : discrete::Show::whole;
        list.items.push_back({p, level, show, double(places.shares[p]), 0, 1});
        list.triangle_count += facts.levels[level].triangle_count;
    }
    std::stable_sort(list.items.begin(), list.items.end(),
                     [](const discrete::Item& a, const discrete::Item& b) { return a.level < b.level; });
    list.in_view_count = list.items.size(), list.tested_count = places.placements.size();
    return list;
}

// As discrete's own of one picture, without its light.
constexpr char kUnlitMain[] = R"(
void main() {
    colour = vec4(encoded(unlit_colour(own_item().is_plain)), 1.0);
}
)";

}  // namespace

Result<Plants> Plants::make(std::span<const discrete::Chain> chains, bool is_lit) {
    Plants made;
    for (const discrete::Chain& chain : chains) {
        Result<discrete::Drawing> drawing = discrete::Drawing::make(chain);
        if (!drawing) return tl::unexpected(drawing.error());
        auto model = std::make_unique<Model>();
        model->facts = discrete::facts_of(chain);
        model->drawing = std::move(*drawing);
        if (!is_lit) {
            Result<gl::Program> unlit = model->drawing.program("unlit plants", "", kUnlitMain);
            if (!unlit) return tl::unexpected(unlit.error());
            model->unlit.emplace(std::move(*unlit));
        }
        made.models_.push_back(std::move(model));
    }
    return made;
}

PlantCounts Plants::draw(const gl::Target& target, const view::Camera& camera, std::span<const PlantPlaces> by_model,
                         double error_px, const std::optional<view::Part>& part) {
    PlantCounts counts;
    discrete::DrawOptions options;
    options.part = part;
    target.bind();
    for (size_t m = 0; m < models_.size(); ++m) {
        Model& model = *models_[m];
        discrete::FrameList frame = listed(model.facts, by_model[m], camera, error_px);
        counts.plant_count += frame.in_view_count, counts.triangle_count += frame.triangle_count;
        if (frame.items.empty()) continue;
        discrete::DrawList list =
            discrete::draw_list(model.drawing.layout(), model.drawing.chain(), frame, by_model[m].placements, camera, 0);
        counts.uploaded_bytes += model.buffers.fill(list);
        const gl::Program& program = model.unlit ? *model.unlit : model.drawing.one_picture();
        model.drawing.draw_calls(program, model.buffers, list, list.whole_calls, options);
        counts.draw_call_count += list.whole_calls.size();
    }
    return counts;
}

uint64_t Plants::bytes() const {
    uint64_t bytes = 0;
    for (const auto& model : models_) bytes += model->drawing.bytes();
    return bytes;
}

}  // namespace overlook::wang_ldi
