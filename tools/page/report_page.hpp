// SPDX-License-Identifier: GPL-3.0-or-later
// Inserts recordings into the bundled page, to make one self-contained HTML file. page_data.hpp describes the
// layout of the data. Data for the first picture come before the page's script, all other blocks after it.
// Tested by tests/tools/commands/report_test.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "specimens/recordings/measured_curve.hpp"
#include "specimens/recordings/recording.hpp"
#include "specimens/recordings/unit_names.hpp"
#include "tools/terminal/messages.hpp"

namespace crackle::tools {

/// Default number of frames. On a laptop screen, one frame then corresponds to about one pixel of the curve.
inline constexpr std::size_t default_page_frames = 500;

enum class PageView { report, view };  ///< what is shown first: tables and curves, or the animation

struct PageHead {
    std::string title;  ///< if empty, the title is derived from the recordings
    PageView view = PageView::report;
    std::optional<UnitNames> units = {};         ///< units of particle files and decks; empty if unknown
    std::optional<LabelledCurve> measured = {};  ///< drawn over the curves of the tests
};

/// @param page the template, which contains each of the markers for data once
/// @return the page; identical recordings give identical bytes
std::string filled_page(std::string_view page, const PageHead& head, const std::vector<Recording>& recordings,
                        Messages& messages);

/// Checks the output path for a page, which may replace an earlier page. @throws InputError if it would replace any
/// other file
std::filesystem::path output_page(const std::filesystem::path& named);

/// Creates the page and writes it under a temporary name, which is then changed to `output`.
/// @throws InputError if this build has no page template, or if `output` exists and is not a page written by crackle
void write_page(const std::filesystem::path& output, const PageHead& head, const std::vector<Recording>& recordings,
                Messages& messages);

/// Prints the details of a recording that -v shows.
void report_recording(Messages& messages, const Recording& recording);

}  // namespace crackle::tools
