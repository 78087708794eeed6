// The five rules.
#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>

#include "tests/layering/layering.h"

namespace overlook::layering {
namespace {

// A room, or the half of one where deciding and drawing share it.
enum class Layer { formats, view, stream, deciding, command, gl, drawing, player, bake, measure, mouth, sample, outside };

std::vector<std::string> parts_of(std::string_view path) {
    std::vector<std::string> parts(1);
    for (char c : path) {
        if (c == '/')
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

Layer layer_of(std::string_view path) {
    std::vector<std::string> parts = parts_of(path);
    if (parts[0] == "formats") return Layer::formats;
    if (parts[0] == "samples") return Layer::sample;
    if (parts.size() < 3) return Layer::outside;
    if (parts[0] == "tools") {
        if (parts[1] == "bake") return Layer::bake;
        return parts[1] == "measure" ? Layer::measure : Layer::mouth;
    }
    if (parts[0] != "runtime") return Layer::outside;
    static const std::map<std::string, Layer> kRooms = {{"view", Layer::view},
                                                        {"stream", Layer::stream},
                                                        {"command", Layer::command},
                                                        {"gl", Layer::gl},
                                                        {"player", Layer::player}};
    if (auto room = kRooms.find(parts[1]); room != kRooms.end()) return room->second;
    return parts.back().starts_with("draw") ? Layer::drawing : Layer::deciding;
}

// Rule 1: what each may know beside itself.
const std::set<Layer>& may_know(Layer from) {
    using enum Layer;
    static const std::map<Layer, std::set<Layer>> kArrows = {
        {formats, {formats}},
        {view, {formats, view}},
        {stream, {formats, view, stream}},
        {deciding, {formats, view, stream, deciding}},
        {command, {formats, command}},
        {gl, {formats, view, gl}},
        {drawing, {formats, view, stream, deciding, gl, drawing}},
        {player, {formats, view, stream, deciding, command, gl, drawing, player}},
        {bake, {formats, view, deciding, bake}},
        {measure, {formats, view, stream, deciding, command, gl, drawing, measure}},
        {mouth, {formats, view, deciding, command, bake, mouth}},
        {sample, {formats, view, stream, deciding, command, gl, drawing, sample}},
        {outside, {}},
    };
    return kArrows.at(from);
}

bool draws(Layer layer) {
    return layer == Layer::gl || layer == Layer::drawing || layer == Layer::player;
}
bool may_use_opengl(Layer layer) {
    return draws(layer) || layer == Layer::measure || layer == Layer::sample;
}
bool is_deciding(Layer layer) {
    return layer == Layer::view || layer == Layer::stream || layer == Layer::deciding || layer == Layer::formats;
}
bool is_lean(Layer layer) {
    return is_deciding(layer) || draws(layer) || layer == Layer::command;
}
// Rule 5: commands talk, and only their mains and what they share end a process.
bool may_print(Layer layer) {
    using enum Layer;
    return layer == command || layer == mouth || layer == measure || layer == player || layer == sample;
}
bool may_end_the_process(const std::string& path, Layer layer) {
    return layer == Layer::command || layer == Layer::sample || (may_print(layer) && path.ends_with("/main.cpp"));
}

bool begins_with_any(std::string_view text, std::span<const std::string_view> prefixes) {
    return std::any_of(prefixes.begin(), prefixes.end(), [&](std::string_view p) { return text.starts_with(p); });
}
bool contains_any(std::string_view text, std::span<const std::string_view> needles) {
    std::string lower(text);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return std::any_of(needles.begin(), needles.end(), [&](std::string_view n) { return lower.find(n) != std::string::npos; });
}

constexpr std::array<std::string_view, 7> kOpenGlHeaders = {"epoxy/", "GL/", "GLES", "EGL/", "KHR/", "GLFW/", "imgui"};
constexpr std::array<std::string_view, 5> kOpenGlLinks = {"epoxy", "opengl::", "egl", "glfw", "imgui"};
constexpr std::array<std::string_view, 8> kBakerHeaders = {"embree",         "OpenMesh/", "CGAL/", "OpenImageIO/",
                                                           "GeographicLib/", "gdal",      "ogr",   "opencv"};
constexpr std::array<std::string_view, 7> kBakerLinks = {"embree",     "openmesh", "cgal",  "openimageio",
                                                         "geographic", "gdal",     "opencv"};

// Rules 1 and 3 on one arrow, included or linked.
void check_arrow(Layer from, Layer to, const Finding& at, const std::string& verb, const std::string& whom,
                 std::vector<Finding>& found) {
    if (to == Layer::outside || may_know(from).contains(to)) return;
    bool is_apart = is_deciding(from) && from != Layer::formats && draws(to);
    found.push_back({is_apart ? 3 : 1, at.file, at.line,
                     verb + " " + whom + (is_apart ? ", which draws; deciding stays apart" : ", which it may not know")});
}

void check_includes(const Source& source, std::vector<Finding>& found) {
    Layer from = layer_of(source.path);
    for (const Include& include : source.includes) {
        Finding at{0, source.path, include.line, ""};
        Layer to = layer_of(include.path);
        check_arrow(from, to, at, "includes", include.path, found);
        // One command never reaches into another.
        if (from == Layer::mouth && to == Layer::mouth && room_of(source.path) != room_of(include.path)) {
            found.push_back({1, at.file, at.line, "includes " + include.path + ", which is another command's"});
        }
        if (!may_use_opengl(from) && begins_with_any(include.path, kOpenGlHeaders)) {
            found.push_back({3, at.file, at.line, "includes <" + include.path + ">; only drawing halves know OpenGL"});
        }
        if (is_lean(from) && begins_with_any(include.path, kBakerHeaders)) {
            found.push_back({2, at.file, at.line, "includes <" + include.path + ">, a library of the bakers"});
        }
    }
}

void check_seams(const Source& source, std::vector<Finding>& found) {
    if (layer_of(source.path) == Layer::sample) return;
    for (const Include& include : source.includes) {
        for (const Seam& seam : seams()) {
            bool is_it = std::any_of(seam.header_prefixes.begin(), seam.header_prefixes.end(),
                                     [&](const std::string& prefix) { return include.path.starts_with(prefix); });
            bool is_named = std::find(seam.files.begin(), seam.files.end(), source.path) != seam.files.end();
            if (!is_it || is_named || (seam.is_light && source.path.ends_with(".cpp"))) continue;
            if (is_lean(layer_of(source.path)) && begins_with_any(include.path, kBakerHeaders)) continue;  // rule 2's
            found.push_back(
                {4, source.path, include.line, "includes <" + include.path + ">, but is not a seam of " + seam.dependency});
        }
    }
}

void check_words(const Source& source, std::vector<Finding>& found) {
    static const std::set<std::string> kStreams = {"cout", "cerr", "clog", "wcout", "wcerr", "stdout", "stderr"};
    static const std::set<std::string> kPrints = {"printf", "vprintf", "puts", "putchar", "perror"};
    static const std::set<std::string> kEnds = {"exit", "_exit", "_Exit", "quick_exit", "abort", "terminate", "raise"};
    Layer layer = layer_of(source.path);
    for (const Word& word : source.words) {
        if (word.is_member || (!word.scope.empty() && word.scope != "std" && word.scope != "fmt")) continue;
        bool is_fmt_print = word.is_call && word.scope == "fmt" && word.text == "print";
        bool prints = kStreams.contains(word.text) || (word.is_call && kPrints.contains(word.text)) || is_fmt_print;
        bool ends = word.is_call && kEnds.contains(word.text);
        if ((prints && !may_print(layer)) || (ends && !may_end_the_process(source.path, layer))) {
            found.push_back({5, source.path, word.line, "uses " + word.text + "; a library returns what went wrong"});
        }
    }
}

Layer layer_of(const Target& target) {
    // Where deciding and drawing share a room, the sources say which half a target is.
    for (const std::string& path : target.sources) {
        if (layer_of(path) == Layer::drawing) return Layer::drawing;
    }
    return layer_of(target.file);
}

void check_targets(const Tree& tree, std::vector<Finding>& found) {
    std::map<std::string, Layer> layers;
    for (const Target& target : tree.targets) {
        auto [entry, is_new] = layers.emplace(target.name, layer_of(target));
        if (!is_new && layer_of(target) == Layer::drawing) entry->second = Layer::drawing;
    }
    for (const Target& target : tree.targets) {
        Layer from = layers.at(target.name);
        Finding at{0, target.file, target.line, ""};
        for (const std::string& path : target.sources) {
            if (from == Layer::drawing && layer_of(path) == Layer::deciding) {
                found.push_back({3, at.file, at.line, target.name + " draws, and has " + path + ", which decides"});
            }
        }
        for (const std::string& link : target.links) {
            if (auto to = layers.find(link); to != layers.end()) {
                check_arrow(from, to->second, at, target.name + " links", link, found);
            } else if (!may_use_opengl(from) && contains_any(link, kOpenGlLinks)) {
                found.push_back({3, at.file, at.line, target.name + " links " + link + "; only drawing halves know OpenGL"});
            } else if (is_lean(from) && contains_any(link, kBakerLinks)) {
                found.push_back({2, at.file, at.line, target.name + " links " + link + ", a library of the bakers"});
            }
        }
    }
}

}  // namespace

std::string room_of(std::string_view path) {
    std::vector<std::string> parts = parts_of(path);
    return parts[0] == "formats" || parts.size() < 3 ? parts[0] : parts[0] + "/" + parts[1];
}

std::string text_of(const Finding& finding) {
    return finding.file + (finding.line > 0 ? ":" + std::to_string(finding.line) : "") + ": rule " +
           std::to_string(finding.rule) + ": " + finding.what;
}

std::vector<Finding> check(const Tree& tree) {
    std::vector<Finding> found;
    for (const Source& source : tree.sources) {
        check_includes(source, found);
        check_seams(source, found);
        check_words(source, found);
    }
    check_targets(tree, found);
    return found;
}

std::vector<Finding> check_lean(const std::string& program, const Libraries& libraries,
                                std::span<const std::string_view> allowed) {
    std::vector<Finding> found;
    for (const std::string& library : libraries.loaded) {
        if (contains_any(library, kBakerLinks)) found.push_back({2, program, 0, "loads " + library});
    }
    for (const std::string& library : libraries.needed) {
        if (!begins_with_any(library, allowed) && !contains_any(library, kBakerLinks)) {
            found.push_back({2, program, 0, "asks for " + library + ", which is not on the list"});
        }
    }
    return found;
}

}  // namespace overlook::layering
