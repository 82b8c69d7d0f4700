// SPDX-License-Identifier: GPL-3.0-or-later
// Fills the bundled page with recordings: one HTML file that needs nothing else. page_data.hpp describes how numbers
// are laid out. What the first picture needs stands before the page's script, all other blocks after it.
// Tested by tests/tools/commands/report_test.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "specimens/recordings/recording.hpp"
#include "specimens/recordings/unit_names.hpp"
#include "tools/terminal/messages.hpp"

namespace crackle::tools {

/// Frames shown where the user states no number: a step on a laptop's screen is a pixel of the curve.
inline constexpr std::size_t default_page_frames = 500;

enum class PageView { report, view };  ///< tables and curves first, or the moving picture

struct PageHead {
    std::string title;  ///< empty: taken from the recordings
    PageView view = PageView::report;
    std::optional<UnitNames> units = {};  ///< of particle files and decks; none: they are not known
};

/// @param page  the template, holding each marker once
/// @return the page's bytes: the same for the same recordings
std::string filled_page(std::string_view page, const PageHead& head, const std::vector<Recording>& recordings,
                        Messages& messages);

/// Fills the page of this build and writes it under a temporary name, which is then renamed.
/// @throws InputError in a build without the page, or where `output` is a file that is no page of ours
void write_page(const std::filesystem::path& output, const PageHead& head, const std::vector<Recording>& recordings,
                Messages& messages);

/// What -v reports of a recording.
void report_recording(Messages& messages, const Recording& recording);

}  // namespace crackle::tools
