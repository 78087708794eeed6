// What the runs of all papers leave in their folder: tables, pictures, charts, a page; and how they come by what they fly over.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "formats/image.h"
#include "formats/result.h"
#include "runtime/command/command.h"
#include "tools/measure/charts.h"

namespace overlook::measure::paper {

// A picture of the page.
struct Picture {
    int figure = 0;       // of the paper; 0: of none
    std::string name;     // of its file: images/figure-7.png
    std::string caption;  // with what is counted in it
    ImageRgb8 image;
};

struct Leavings {
    std::vector<std::pair<std::string, std::string>> tables;           // a file's name, what is in it
    std::vector<std::pair<std::string, const ImageRgb8*>> pictures{};  // a name without images/ and .png
    std::vector<Chart> charts{};
    std::function<std::string(bool has_charts)> page;  // HTML
    std::vector<std::string> targets{};                // what is said of each, a line
};
void add_pictures(Leavings& leavings, const std::vector<Picture>& pictures);

// Writes it all into `out`, in which images/ is, and says the targets and where the page is. Fails with Exit::cannot_write.
Result<void> leave(const Leavings& leavings, const std::string& out, const command::Common& common);

// Each folder's subject, as read(folder) finds it. Fails as that does, and with Exit::bad_command:
//   "b/hills: another folder is called hills too; give each a name of its own"
template <class Subject>
Result<std::vector<Subject>> read_each(const std::vector<std::string>& folders, Result<Subject> (*read)(const std::string&)) {
    std::vector<Subject> subjects;
    for (const std::string& folder : folders) {
        Result<Subject> subject = read(folder);
        if (!subject) return tl::unexpected(subject.error());
        if (std::any_of(subjects.begin(), subjects.end(), [&](const Subject& one) { return one.name == subject->name; }))
            return bad_command("{}: another folder is called {} too; give each a name of its own", folder, subject->name);
        subjects.push_back(std::move(*subject));
    }
    return subjects;
}

}  // namespace overlook::measure::paper
