// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/page/report_page.hpp"

#include <fmt/format.h>

#include <array>
#include <system_error>

#include "solver/base/errors.hpp"
#include "solver/base/version.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/recordings/distinct_names.hpp"
#include "tools/page/page_data.hpp"
#include "tools/page/page_template.hpp"

namespace crackle::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Markers for the manifest, the blocks of the first picture, and all other blocks.
constexpr std::array<std::string_view, 3> markers{"@CRACKLE_DATA@", "@CRACKLE_FIRST@", "@CRACKLE_REST@"};

/// Escapes `<`, the only dangerous character inside a script element (</script>, <!--). In JSON it occurs only within
/// strings.
std::string safe_in_script(const std::string& json) {
    std::string out;
    out.reserve(json.size());
    for (const char letter : json) {
        if (letter == '<') {
            out += "\\u003c";
        } else {
            out += letter;
        }
    }
    return out;
}

std::string default_title(const std::vector<Recording>& recordings) {
    if (recordings.size() != 1) return "Virtual rock tests";
    const Recording& recording = recordings.front();
    const std::string title = recording.results.summary.about.title.value_or("");
    return title.empty() ? recording.name : title;
}

void append_block(std::string& out, std::size_t recording, std::size_t block, const std::string& text) {
    out += fmt::format("<script type=\"application/octet-stream\" id=\"crackle-{}-{}\">", recording, block);
    out += text;
    out += "</script>\n";
}

}  // namespace

std::filesystem::path output_page(const std::filesystem::path& named) {
    std::filesystem::path output = output_file(named);
    if (!is_there(output) || is_report_page(output)) return output;
    throw InputError(
        fmt::format("{}: found a file that is not a page written by crackle, expected a new name or an earlier page; "
                    "choose another name with -o",
                    output.string()));
}

std::string filled_page(std::string_view page, const PageHead& head, const std::vector<Recording>& recordings,
                        Messages& messages) {
    if (page.empty()) {
        throw InputError(
            "this build of crackle contains no report page; configure with -DCRACKLE_VIEWER=ON (this needs Node 18 or "
            "later, and npm)");
    }
    Json manifest{{"format", "crackle-report 2"},
                  {"title", head.title.empty() ? default_title(recordings) : head.title},
                  {"version", project_version},
                  {"view", head.view == PageView::report ? "report" : "view"},
                  {"tests", Json::array()}};
    if (head.units)
        manifest["units"] = {{"length", head.units->length}, {"velocity", head.units->velocity},
                             {"force", head.units->force},   {"energy", head.units->energy},
                             {"stress", head.units->stress}, {"prefixes", head.units->prefixes}};
    if (head.measured) {
        Json strain = Json::array(), stress = Json::array();
        for (const auto& [x, y] : head.measured->points) strain.push_back(x), stress.push_back(y);
        manifest["measured"] = {{"label", head.measured->label}, {"strain", strain}, {"stress", stress}};
    }
    std::array<std::string, 3> texts;
    std::size_t all_frames = 0, frames_before = 0;
    for (const Recording& recording : recordings) all_frames += recording.frames.size();
    const std::vector<std::string> names = distinct_names(recordings);
    messages.progress().begin("packing frames", static_cast<double>(all_frames), "frames");
    for (std::size_t k = 0; k < recordings.size(); ++k) {
        PageData data = pack_recording(recordings[k], [&](std::size_t frames) {
            messages.progress().count(static_cast<double>(frames_before + frames), recordings[k].name);
        });
        frames_before += recordings[k].frames.size();
        data.manifest["name"] = names[k];
        manifest["tests"].push_back(std::move(data.manifest));
        for (std::size_t block = 0; block < data.blocks.size(); ++block)
            append_block(texts[block == 0 ? 1 : 2], k, block, data.blocks[block]);
    }
    // Names from the file system may not be valid UTF-8; replacement characters are shown instead of an error.
    texts[0] = safe_in_script(manifest.dump(-1, ' ', false, Json::error_handler_t::replace));

    std::string out;
    for (std::size_t k = 0; k < markers.size(); ++k) {
        const std::size_t at = page.find(markers[k]);
        if (at == std::string_view::npos) throw std::logic_error("the bundled page lacks a marker");
        out += page.substr(0, at);
        out += texts[k];
        page.remove_prefix(at + markers[k].size());
    }
    return out += page;
}

void write_page(const std::filesystem::path& output, const PageHead& head, const std::vector<Recording>& recordings,
                Messages& messages) {
    output_page(output);
    const std::string page = filled_page(page_template(), head, recordings, messages);
    replace_file(output, page);
    messages.make_room();
    messages.detail(fmt::format("{}: {} bytes", output.string(), page.size()));
}

void report_recording(Messages& messages, const Recording& recording) {
    messages.detail(fmt::format("{}: {} cells, {} bonds, {} frames to show", recording.name, recording.cells.size(),
                                recording.bonds.size(), recording.frames.size()));
}

}  // namespace crackle::tools
