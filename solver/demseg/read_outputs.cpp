// SPDX-License-Identifier: GPL-3.0-or-later
// See read_outputs.hpp.

#include "solver/demseg/read_outputs.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <limits>
#include <thread>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/demseg/deck_folder.hpp"
#include "solver/demseg/deck_reader.hpp"
#include "solver/files/file_set.hpp"
#include "solver/files/read_file.hpp"
#include "solver/measure/breaks.hpp"

namespace crackle {
namespace {

constexpr std::array<const char*, 4> files_read{"output.dat", "cont.dat", "cont2.dat", "events.csv"};

constexpr int largest_number = std::numeric_limits<int>::max();
constexpr std::int64_t most_lines = 1'000'000'000;

DeckReader reader_of(const DeckFrameFile& file, const DeckFrameFile::Head& head) {
    return {file.path().string(), file.lines(head), head.line + 1};
}

Vec2 read_place(DeckReader& reader, const char* x_key, const char* y_key) {
    const double x = reader.number(x_key);
    return {x, reader.number(y_key)};
}

int read_id(DeckReader& reader, const char* key, int lowest) {
    return static_cast<int>(reader.integer(key, lowest, largest_number));
}

/// First line (head) of the frame of a given step; nullptr if the file has no such frame.
const DeckFrameFile::Head* head_of_step(const DeckFrameFile& file, std::int64_t step) {
    const auto& heads = file.heads();
    const auto found = std::lower_bound(heads.begin(), heads.end(), step,
                                        [](const DeckFrameFile::Head& head, std::int64_t s) { return head.step < s; });
    return found == heads.end() || found->step != step ? nullptr : &*found;
}

std::optional<DeckFrameFile> file_if_there(const std::filesystem::path& path) {
    if (!is_there(path)) return std::nullopt;
    return DeckFrameFile(path, 1);
}

DeckBreaks read_breaks(const std::filesystem::path& file) {
    if (!is_there(file)) return {};
    std::string text = read_file(file);
    text.resize(text.rfind('\n') + 1);  // a killed run may have left an incomplete last line
    const std::string names = breaks_header();
    if (text.starts_with(names)) return {std::move(text), 1};
    if (text.empty() || (text.front() >= '0' && text.front() <= '9')) return {names + text, 0};
    throw InputError(fmt::format("{}:1: found '{:.40}', expected the broken bonds that `crackle run` lists: {:.40}...",
                                 file.string(), text.substr(0, text.find('\n')), names));
}

}  // namespace

DeckFrameFile::DeckFrameFile(std::filesystem::path path, int counts) : path_(std::move(path)) {
    errno = 0;
    file_.open(path_, std::ios::binary);
    if (!file_)
        fail_reading(errno, fmt::format("{}: cannot be read ({}), expected the output of `crackle run`", path_.string(),
                                        std::strerror(errno)));
    std::string line;
    std::int64_t at = 0;
    int number = 0;
    while (std::getline(file_, line) && !file_.eof()) {
        at += static_cast<std::int64_t>(line.size()) + 1;
        ++number;
        if (line.starts_with('#')) continue;
        Head head;
        DeckReader words(path_.string(), line, number);
        head.step = words.integer("step", 0, std::numeric_limits<std::int64_t>::max());
        head.time = words.number("time");
        std::int64_t lines = 0;
        for (int k = 0; k < counts; ++k) {
            head.counts.push_back(words.integer("count", 0, most_lines));
            lines += head.counts.back();
        }
        words.expect_end("the counts");
        if (!heads_.empty() && head.step <= heads_.back().step) {
            throw InputError(fmt::format("{}:{}: found step {} after step {}, expected increasing steps",
                                         path_.string(), number, head.step, heads_.back().step));
        }
        head.offset = at;
        head.line = number;
        for (; lines > 0 && std::getline(file_, line) && !file_.eof(); --lines) {
            at += static_cast<std::int64_t>(line.size()) + 1;
            ++number;
        }
        head.bytes = at - head.offset;
        if (lines == 0) heads_.push_back(std::move(head));
    }
}

std::string DeckFrameFile::lines(const Head& head) const {
    std::string text(static_cast<std::size_t>(head.bytes), '\0');
    file_.clear();
    file_.seekg(head.offset);
    file_.read(text.data(), head.bytes);
    if (!file_) throw InputError(fmt::format("{}:{}: the frame cannot be read", path_.string(), head.line));
    return text;
}

DeckFrames::Identities DeckFrames::identities(const std::filesystem::path& folder) {
    Identities all{};
    for (std::size_t k = 0; k < files_read.size(); ++k) {
        struct stat found {};
        if (::stat((folder / files_read[k]).c_str(), &found) == 0) all[k] = {found.st_dev, found.st_ino};
    }
    return all;
}

DeckFrames::Identities DeckFrames::whole_set(const std::filesystem::path& folder) {
    // A journal exists while a run is saving, or if it was interrupted while saving. As long as the run holds the
    // folder, completing the replacement fails and is retried; a save takes only a moment.
    constexpr int most_tries = 50;
    constexpr std::chrono::milliseconds between_tries{100};
    for (int tries = 1; gives_name(deck_journal(folder), files_read); ++tries) {
        try {
            complete_deck_replacement(folder);
        } catch (const OutputError&) {
            if (tries == most_tries) throw;
            std::this_thread::sleep_for(between_tries);
        }
    }
    return identities(folder);
}

DeckFrames::DeckFrames(const std::filesystem::path& folder)
    : folder_(folder),
      opened_(whole_set(folder)),
      positions_(folder / files_read[0], 2),
      forces_(file_if_there(folder / files_read[1])),
      details_(file_if_there(folder / files_read[2])),
      breaks_(read_breaks(folder / files_read[3])) {
    require_unchanged();
    if (positions_.heads().empty()) {
        throw InputError(fmt::format("{}: found no complete frame, expected at least one written by `crackle run`",
                                     positions_.path().string()));
    }
}

void DeckFrames::require_unchanged() const {
    if (identities(folder_) == opened_) return;
    throw InputError(
        fmt::format("{}: found outputs that a new run replaced while they were read, expected those of one run; "
                    "repeat the command",
                    folder_.string()));
}

DeckFrames::Positions DeckFrames::positions(std::size_t k) const {
    const DeckFrameFile::Head& head = heads()[k];
    DeckReader reader = reader_of(positions_, head);
    Positions all;
    for (std::int64_t n = 0; n < head.counts[0]; ++n) {
        DeckCircle circle;
        circle.id = read_id(reader, "body", 1);
        circle.radius = reader.positive_number("radius");
        circle.centre = read_place(reader, "xc", "yc");
        circle.angle = reader.number("angle");
        all.circles.push_back(circle);
    }
    for (std::int64_t n = 0; n < head.counts[1]; ++n) {
        DeckSegment segment;
        segment.id = read_id(reader, "body", 1);
        segment.start = read_place(reader, "xs", "ys");
        segment.end = read_place(reader, "xe", "ye");
        all.segments.push_back(segment);
    }
    reader.expect_end("the frame's bodies");
    return all;
}

std::vector<DeckContact> DeckFrames::contacts(std::size_t k) const {
    const std::int64_t step = heads()[k].step;
    const DeckFrameFile::Head* forces_head = forces_ ? head_of_step(*forces_, step) : nullptr;
    const DeckFrameFile::Head* details_head = details_ ? head_of_step(*details_, step) : nullptr;
    if (!forces_head || !details_head) return {};
    if (forces_head->counts != details_head->counts) {
        throw InputError(fmt::format("{}:{}: found {} contacts, expected {} as in cont.dat", details_->path().string(),
                                     details_head->line, details_head->counts[0], forces_head->counts[0]));
    }
    DeckReader forces = reader_of(*forces_, *forces_head), details = reader_of(*details_, *details_head);
    std::vector<DeckContact> all;
    for (std::int64_t n = 0; n < forces_head->counts[0]; ++n) {
        DeckContact contact;
        contact.id = read_id(forces, "body", 1);
        contact.other = read_id(forces, "other", -4);
        contact.place = read_place(forces, "x", "y");
        contact.force = read_place(forces, "fx", "fy");
        if (read_id(details, "body", 1) != contact.id || read_id(details, "other", -4) != contact.other) {
            details.refuse("body, other", fmt::format("{} and {}, as in cont.dat", contact.id, contact.other));
        }
        for (const char* passed_over : {"nx", "ny", "overlap"}) details.number(passed_over);
        contact.normal_force = details.number("normal_force");
        contact.shear_force = details.number("shear_force");
        contact.back_tension = details.number("back_tension");
        all.push_back(contact);
    }
    return all;
}

}  // namespace crackle
