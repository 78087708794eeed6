#include "tools/measure/paper/leave.h"

#include "formats/atomic_file.h"
#include "runtime/gl/png.h"

namespace overlook::measure::paper {

void add_pictures(Leavings& leavings, const std::vector<Picture>& pictures) {
    for (const Picture& picture : pictures) leavings.pictures.emplace_back(picture.name, &picture.image);
}

Result<void> leave(const Leavings& leavings, const std::string& out, const command::Common& common) {
    for (const auto& [name, text] : leavings.tables) {
        if (Result<void> written = write_file(out + "/" + name, std::string_view(text)); !written) return written;
    }
    for (const auto& [name, image] : leavings.pictures) {
        if (Result<void> written = write_png(out + "/images/" + name + ".png", *image); !written) return written;
    }
    Result<bool> drawn = draw_charts(leavings.charts, out);
    if (!drawn) return tl::unexpected(drawn.error());
    if (!*drawn) command::note(common, "reproduce: gnuplot is not installed; the charts are left out");
    std::string page = leavings.page(*drawn);
    if (Result<void> written = write_file(out + "/index.html", std::string_view(page)); !written) return written;
    for (const std::string& line : leavings.targets) command::note(common, "reproduce: " + line);
    command::note(common, fmt::format("reproduce: the page: {}/index.html", out));
    return {};
}

}  // namespace overlook::measure::paper
