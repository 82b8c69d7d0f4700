// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plot/panels.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/base/errors.hpp"
#include "solver/base/threads_to_be_had.hpp"
#include "tools/plot/legend.hpp"

namespace crackle::plot {
namespace {

/// Pango begins two to look for fonts, and ends the process where it is refused one.
void refuse_without_threads() {
    constexpr int needed = 4;  // with this one, and one to spare: a thread that has ended is counted for a moment yet
    static const bool had = threads_to_be_had(needed) == needed;  // once begun, they stay
    if (had) return;
    throw InputError(
        "plot: found no room for a further thread (Resource temporarily unavailable), expected two, which look for "
        "fonts; end other programs of this user, or raise its limit (ulimit -u)");
}

/// a, b, ..., z, aa, ab, ...
std::string letters_of(std::size_t number) {
    constexpr std::size_t letters = 26;
    const std::string last(1, static_cast<char>('a' + number % letters));
    return number < letters ? last : letters_of(number / letters - 1) + last;
}

}  // namespace

std::string figure(const std::vector<Panel>& panels, const std::string& title, double width, Format format,
                   const SheetStyle& style) {
    std::vector<std::vector<Panel>> rows;
    rows.reserve(panels.size());
    for (const Panel& panel : panels) rows.push_back({panel});
    return figure(rows, title, width, format, style);
}

std::string figure(const std::vector<std::vector<Panel>>& rows, const std::string& title, double width, Format format,
                   const SheetStyle& style) {
    refuse_without_threads();
    constexpr double margin = 2.0;  // pt, around the figure
    const double between = 1.5 * style.font_size;
    const double inside = width - 2.0 * margin;
    const double title_height = title.empty() ? 0.0 : 2.0 * style.font_size;
    std::size_t panels = 0;
    for (const std::vector<Panel>& row : rows) panels += row.size();
    const auto letter_height = [&](const Panel& panel) {
        return (panels > 1 && panel.letter_above) || !panel.title.empty() ? 1.5 * style.font_size : 0.0;
    };
    const auto panel_width = [&](const std::vector<Panel>& row) {
        const auto count = static_cast<double>(row.size());
        return (inside - between * (count - 1.0)) / count;
    };
    const auto row_height = [&](const Canvas& measure, const std::vector<Panel>& row) {
        double highest = 0.0;
        for (const Panel& panel : row)
            highest = std::max(highest, letter_height(panel) + panel.height(measure, panel_width(row)));
        return highest;
    };
    const Canvas measure(1.0, 1.0, Format::svg, style);
    double height = 2.0 * margin + title_height + between * static_cast<double>(rows.size() - 1);
    for (const std::vector<Panel>& row : rows) height += row_height(measure, row);

    Canvas canvas(width, height, format, style);
    if (!title.empty()) canvas.text({0.5 * width, margin}, escaped(title), Across::centre, Down::top, 1.1);
    double y = margin + title_height;
    std::size_t number = 0;
    for (const std::vector<Panel>& row : rows) {
        const double bottom = y + row_height(measure, row);
        double x = margin;
        for (const Panel& panel : row) {
            const double top = y + letter_height(panel);
            panel.draw(canvas, {x, top, panel_width(row), bottom - top});
            if (!panel.title.empty()) {
                const double beside = panels > 1 ? beside_letter : 0.0;
                const std::string text = escaped(panel.title);
                const double fits = (panel_width(row) - beside) / canvas.size_of(text).width;
                canvas.text({x + beside, y}, text, Across::left, Down::top, std::min(1.0, fits), ink);
            }
            std::vector<double> letters;
            if (panel.more_letters) letters = panel.more_letters(panel_width(row));
            letters.insert(letters.begin(), 0.0);
            for (const double at : letters) {
                if (panels > 1)
                    canvas.text({x + at, y}, fmt::format("<b>({})</b>", letters_of(number++)), Across::left, Down::top,
                                1.1);
            }
            x += panel_width(row) + between;
        }
        y = bottom + between;
    }
    return canvas.finish();
}

}  // namespace crackle::plot
