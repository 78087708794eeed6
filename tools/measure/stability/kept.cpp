// A file is the 32 hex digits of its payload's hash, then the payload: an array of findings in CBOR, which has infinite numbers
// and bytes.
#include "tools/measure/stability/kept.h"

#include <cstring>
#include <nlohmann/json.hpp>

#include "formats/atomic_file.h"
#include "formats/container.h"
#include "formats/mapped_file.h"

namespace overlook::measure {
namespace {

using Json = nlohmann::json;
constexpr size_t kHashDigits = 32;

std::string hash_of(const std::string& text) {
    return content_hash(std::as_bytes(std::span(text)));
}

Json json_of(const ImageRgb8& image) {
    return {{"width", image.width}, {"height", image.height}, {"pixels", Json::binary(image.pixels)}};
}
ImageRgb8 image_from(const Json& json) {
    return {json.at("width").get<uint32_t>(), json.at("height").get<uint32_t>(), json.at("pixels").get_binary()};
}

Json json_of(const Finding& finding) {
    Json json = {{"figures", finding.figures},
                 {"sentence", finding.sentence},
                 {"frames", finding.frames},
                 {"promised_px", finding.promised_px}};
    if (finding.worst) {
        const Shot& shot = *finding.worst;
        json["worst"] = {{"frame", shot.frame}, {"test", json_of(shot.test)}, {"reference", json_of(shot.reference)}};
    }
    return json;
}
Finding finding_from(const Json& json) {
    Finding finding;
    finding.figures = json.at("figures").get<std::map<std::string, double>>();
    finding.sentence = json.at("sentence").get<std::string>();
    finding.frames = json.at("frames").get<uint32_t>();
    finding.promised_px = json.at("promised_px").get<std::vector<double>>();
    if (json.contains("worst")) {
        const Json& shot = json.at("worst");
        finding.worst = Shot{shot.at("frame").get<uint32_t>(), image_from(shot.at("test")), image_from(shot.at("reference"))};
    }
    return finding;
}

}  // namespace

Result<std::string> program_hash() {
    Result<MappedFile> file = MappedFile::open("/proc/self/exe");
    if (!file) return tl::unexpected(file.error());
    return content_hash(file->bytes());
}

std::string name_of_findings(const Stage& stage, const Case& each, const scene::Flight& flight,
                             std::span<const MethodSpec> specs) {
    const CaseSettings& settings = each.settings;
    std::string all = fmt::format("{} {} {} {} {} {} {} {}\n", stage.program_hash, stage.renderer.name, stage.renderer.version,
                                  stage.world.content_hash, stage.width_px, stage.height_px, stage.frames, stage.asked_px);
    all += fmt::format("{} {} {} {} {} {}\n", each.number, settings.drop_every, settings.budget_share, settings.cameras,
                       settings.goes_backwards, settings.changed_pixel.value_or(-1));
    for (double move_m : settings.world_moves_m) all += fmt::format("{} ", move_m);
    for (double share : settings.resize_shares) all += fmt::format("/{} ", share);
    all += scene::json_from_flight(flight);
    std::string names = each.number;
    for (const MethodSpec& spec : specs) all += label_of(spec) + "\n";
    return names + "-" + hash_of(all);
}

std::optional<std::vector<Finding>> read_findings(const std::string& path, size_t count) {
    Result<MappedFile> file = MappedFile::open(path);
    if (!file || file->bytes().size() < kHashDigits) return std::nullopt;
    std::span<const std::byte> bytes = file->bytes(), payload = bytes.subspan(kHashDigits);
    if (std::memcmp(bytes.data(), content_hash(payload).data(), kHashDigits) != 0) return std::nullopt;
    const uint8_t* begin = reinterpret_cast<const uint8_t*>(payload.data());
    Json all = Json::from_cbor(begin, begin + payload.size(), true, false);
    if (!all.is_array() || all.size() != count) return std::nullopt;
    std::vector<Finding> findings;
    for (const Json& json : all) findings.push_back(finding_from(json));
    return findings;
}

Result<void> keep_findings(const std::string& path, const std::vector<Finding>& findings) {
    Json all = Json::array();
    for (const Finding& finding : findings) all.push_back(json_of(finding));
    std::vector<uint8_t> payload = Json::to_cbor(all);
    std::string hash = content_hash(std::as_bytes(std::span(payload)));
    std::vector<std::byte> bytes(kHashDigits + payload.size());
    std::memcpy(bytes.data(), hash.data(), kHashDigits);
    std::memcpy(bytes.data() + kHashDigits, payload.data(), payload.size());
    return write_file(path, std::span<const std::byte>(bytes));
}

}  // namespace overlook::measure
