// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plot/panels.hpp"

#include <fmt/format.h>

namespace crackle::plot {

std::string figure(const std::vector<Panel>& panels, const std::string& title, double width, Format format,
                   const SheetStyle& style) {
    constexpr double margin = 2.0;  // pt, around the figure
    const double between = 1.5 * style.font_size;
    const double inside = width - 2.0 * margin;
    const double title_height = title.empty() ? 0.0 : 2.0 * style.font_size;
    const auto letter_height = [&](const Panel& panel) {
        return panels.size() > 1 && panel.letter_above ? 1.5 * style.font_size : 0.0;
    };
    const Canvas measure(1.0, 1.0, Format::svg, style);
    double height = 2.0 * margin + title_height + between * static_cast<double>(panels.size() - 1);
    for (const Panel& panel : panels) height += letter_height(panel) + panel.height(measure, inside);

    Canvas canvas(width, height, format, style);
    if (!title.empty()) canvas.text({0.5 * width, margin}, escaped(title), Across::centre, Down::top, 1.1);
    double y = margin + title_height;
    char letter = 'a';
    for (const Panel& panel : panels) {
        const Rect place{margin, y + letter_height(panel), inside, panel.height(measure, inside)};
        panel.draw(canvas, place);
        if (panels.size() > 1)
            canvas.text({place.x, y}, fmt::format("<b>({})</b>", letter++), Across::left, Down::top, 1.1);
        y = place.bottom() + between;
    }
    return canvas.finish();
}

}  // namespace crackle::plot
