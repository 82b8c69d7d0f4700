// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plot/panels.hpp"

#include <fmt/format.h>
#include <glib.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "solver/base/system_failure.hpp"
#include "solver/machine/threads_to_be_had.hpp"
#include "tools/plot/legend.hpp"

namespace crackle::plot {
namespace {

/// After a fatal error, GLib ends the process by a signal. This handler ends it with a message and an exit code
/// instead, like any other failure.
void end_by_glib(const char* domain, GLogLevelFlags level, const char* message, void* data) {
    if ((level & G_LOG_FLAG_FATAL) == 0) {
        g_log_default_handler(domain, level, message, data);
        return;
    }
    constexpr int exit_code_system_fails = 4;
    for (const std::string_view text :
         {std::string_view("crackle: plot: "), std::string_view(message),
          std::string_view("; end other programs of this user, or raise the user's limits (ulimit -u, ulimit -v)\n")})
        if (::write(STDERR_FILENO, text.data(), text.size()) < 0) break;
    ::_exit(exit_code_system_fails);
}

/// Pango starts two threads to search for fonts, and ends the process if one cannot be created.
void refuse_without_threads() {
    // This number includes this thread and a spare one, since a thread that has ended is still counted for a moment.
    constexpr int needed = 4;
    static const bool had = threads_to_be_had(needed) == needed;  // once started, these threads remain
    if (had) return;
    throw SystemFailure(
        "plot: cannot start another thread (Resource temporarily unavailable), expected two threads that search for "
        "fonts; end other programs of this user, or raise the user's limit (ulimit -u)");
}

/// Refuses to draw if memory is short, since GLib and fontconfig kill the process with a signal if they run out of
/// memory.
/// @param sheet bytes of the image
void refuse_without_memory(double sheet) {
    // Bytes for two threads that search for fonts, each with an arena of 64 MiB from glibc and a stack, and for the
    // data that they read. To align an arena, glibc temporarily maps twice its size.
    constexpr double of_fonts = (3.0 * 64.0 + 2.0 * 8.0 + 32.0) * (1 << 20);
    // Copies of the sheet in memory while it is drawn, its colours are converted, and it is compressed.
    constexpr double sheets = 3.0;
    const auto needed = static_cast<std::size_t>(of_fonts + sheets * sheet);
    void* const room = mmap(nullptr, needed, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED) {
        throw SystemFailure(
            fmt::format("plot: cannot allocate {} MiB ({}), which fonts and the figure need; end other programs, or "
                        "raise the limit (ulimit -v)",
                        needed >> 20, std::strerror(errno)));
    }
    munmap(room, needed);
}

/// Letters of a panel: a, b, ..., z, aa, ab, ...
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
    g_log_set_default_handler(end_by_glib, nullptr);
    refuse_without_memory(0.0);
    refuse_without_threads();
    constexpr double margin = 2.0;  // pt, margin around the figure
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

    const double pixels_a_point = style.dpi / 72.0, pixel = 4.0;  // pixels per point, and bytes per pixel
    if (format == Format::png) refuse_without_memory(pixel * width * height * pixels_a_point * pixels_a_point);
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
