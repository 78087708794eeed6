#include "runtime/player/overlay.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace overlook::player {
namespace {

void text_line(const std::string& line) {
    ImGui::TextUnformatted(line.data(), line.data() + line.size());
}

std::string megabytes(uint64_t bytes) {
    return fmt::format("{:.2f} MB", double(bytes) / 1e6);
}

// Of planted ground: what was warped, what stands in for what, and whether the eye is where images were not sampled for.
void planting_lines(const wang_ldi::FrameCounts& planting, bool shows_rings) {
    text_line(fmt::format("planting {} tiles, {} far blocks; {} samples in {:.1f} ms by {} threads{}",
                          planting.field.tiles_listed, planting.field.blocks_listed, planting.warp.samples, planting.warp_ms,
                          planting.threads, planting.latency_frames > 0 ? ", a frame late" : ""));
    if (planting.images.stand_ins + planting.images.missing > 0)
        text_line(fmt::format("       {} of {} images have others in their place, {} are missing", planting.images.stand_ins,
                              planting.images.images, planting.images.missing));
    if (planting.is_eye_outside)
        text_line(
            fmt::format("       outside the cell: images were not sampled for eyes so high above the ground ({} tiles "
                        "by images for other eyes)",
                        planting.field.outside_cell));
    if (shows_rings) text_line("hues: levels, from near to far; dark and light: directions");
}

// Which method draws; of LOD-sprite what its keys do.
void method_lines(const OverlayText& text) {
    text_line(fmt::format("method {}", name_of(text.method)));
    if (text.frame->chain) {
        const discrete::FrameCounts& chain = *text.frame->chain;
        text_line(fmt::format("{} instances in view, {} on their way between levels; {} calls", chain.in_view_count,
                              chain.fading_count, chain.draw_call_count));
    }
    if (text.frame->mesh) {
        const caveclod::FrameCounts& mesh = *text.frame->mesh;
        text_line(fmt::format("splits {}, {} forced; collapses {}{}", mesh.split_count, mesh.forced_count, mesh.collapse_count,
                              mesh.is_settled ? "" : "; more to come"));
        if (mesh.wrong_corner_count > 0) text_line(fmt::format("       {} wrong corners", mesh.wrong_corner_count));
    }
    if (text.frame->planting) planting_lines(*text.frame->planting, text.shows_sources);
    if (text.frame->stream) {
        const StreamRecord& stream = *text.frame->stream;
        text_line(fmt::format("stream {} of {} there, {} {} asked for, {} without room", megabytes(stream.counts.resident_bytes),
                              megabytes(stream.budget_bytes), stream.counts.asked_count,
                              text.frame->mesh       ? "blocks"
                              : text.frame->planting ? "images"
                                                     : "tiles",
                              stream.counts.refused_count));
        if (text.frame->mesh)
            text_line(fmt::format("       {} of {} blocks; what is missing is {:.2f} px", stream.resident_block_count,
                                  stream.block_count, text.frame->mesh->missing_px));
        if (stream.stopped_count > 0) text_line(fmt::format("       {} triangles coarser than asked", stream.stopped_count));
    }
    if (!text.frame->sprite) return;
    const lod_sprite::FrameCounts& sprite = *text.frame->sprite;
    std::string last = text.keys.cause == lod_sprite::Cause::none
                           ? "none in use yet"
                           : fmt::format("the last {} frames ago: {}", text.keys.frames_ago, name_of(text.keys.cause));
    text_line(fmt::format("keys   {} live, {}", sprite.live_key_count, last));
    text_line(fmt::format("       {} triangles into keys in this frame", sprite.key_triangle_count));
    if (text.method == Method::lod_sprite_paper) return;  // which predicts neither
    text_line(fmt::format("       {:.2f} px the p99 predicted, {:.2f} px the most; {:.2f} % lost", sprite.error_p99_px,
                          sprite.error_max_px, 100 * sprite.lost_share));
    if (text.shows_sources) text_line("grey: key; yellow: another key; blue: near geometry; red: no key shows it");
}

// What the keys do with this method.
std::string key_line(Method method) {
    std::string looks = has_wireframe(method)          ? "F wireframe, "
                        : method == Method::lod_sprite ? "K sources, "
                        : shows_sources(method)        ? "K rings, "
                                                       : "";
    return "+ - error, M method, " + looks + "H this text, P picture, R record, Esc ends";
}

}  // namespace

Overlay::Overlay(GLFWwindow* window) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowRounding = 6;
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 450 core");
}

Overlay::~Overlay() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Overlay::draw(const OverlayText& text) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    ImGui::SetNextWindowPos(ImVec2(12, 12));
    ImGui::SetNextWindowBgAlpha(0.62f);
    const ImGuiWindowFlags plain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
                                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
    ImGui::Begin("Overlook", nullptr, plain);
    text_line(fmt::format("{} triangles, {} places tested, {} sent", text.frame->triangle_count, text.frame->tested_count,
                          megabytes(text.frame->uploaded_bytes)));
    method_lines(text);
    text_line(fmt::format("refine {:6.2f} ms   draw {:6.2f} ms", text.frame->refine_ms, text.frame->draw_ms));
    text_line(fmt::format("error  {:.3g} px asked, {:.2f} px predicted", text.error_px, text.frame->predicted_error_px));
    text_line(fmt::format("speed  x {:.3g}", text.speed_factor));
    text_line(fmt::format("{} x {}, {}{}", text.width_px, text.height_px, text.renderer->name,
                          text.renderer->is_software ? " (software)" : ""));
    ImGui::Separator();
    text_line("W A S D move, Q E down/up, mouse looks, Shift faster, wheel speed");
    text_line(key_line(text.method));
    if (text.is_recording) text_line("recording; R ends it");
    ImGui::End();
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace overlook::player
