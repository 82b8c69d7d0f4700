// SPDX-License-Identifier: GPL-3.0-or-later
// The checkpoint of a test. Its hashes are corrected, so that the code behind them is reached. The state that was read
// is drawn as in a resumed test, so that invalid indices would be used.

#include "specimens/results/checkpoint.hpp"

#include <algorithm>
#include <span>
#include <sstream>

#include "specimens/frames/frame_forces.hpp"
#include "specimens/frames/frame_painter.hpp"
#include "specimens/frames/placed_frame.hpp"
#include "specimens/results/sha256.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

namespace {

/// Uses the current layout version, so that stored inputs stay valid.
std::string title() {
    std::ostringstream out;
    crackle::save_test(out, "", {}, {}, {});
    const std::string text = std::move(out).str();
    return text.substr(0, text.find('\n'));
}

}  // namespace

void crackle::fuzz::checkpoint(std::string_view bytes) {
    constexpr std::size_t digits = 64;
    static const std::string first_line = title();
    std::string text(bytes);
    if (text.starts_with("crackle")) text.replace(0, std::min(text.find('\n'), text.size()), first_line);
    if (text.size() > digits) {
        const std::size_t end = text.size() - digits;
        mend_world(text, end);
        text.replace(end, digits, sha256(text.substr(0, end)));
    }
    std::istringstream in(std::move(text));
    const TestCheckpoint test = load_test(in, "checkpoint");
    const Frame& frame = test.state.peak_frame;
    if (frame.row < 0) return;
    std::ostringstream drawn;
    const PlacedFrame placed(test.world, test.setup, frame);
    const FrameForces forces = find_forces(placed);
    const std::span cracks = std::span(test.state.history.cracks).first(frame.cracks);
    const FramePainter painter(test.world, test.setup, FramePrecision::double_);
    painter.write_particles(drawn, placed, forces);
    painter.write_contacts(drawn, placed, forces, cracks);
    painter.write_cracks(drawn, placed, cracks);
    painter.write_joints(drawn, placed);
}
