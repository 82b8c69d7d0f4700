// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plot/face_bands.hpp"

#include <algorithm>
#include <cmath>

#include "tools/plot/legend.hpp"

namespace crackle::plot {

Colour band_fill(bool compression) {
    constexpr double tint = 0.6;
    return tinted(compression ? compressive_colour : tensile_colour, tint);
}

bool has_faces(const Recording& recording) {
    return !recording.frames.empty() && !recording.frame(0).stress_begin.empty();
}

std::optional<FaceBand> face_band(const RecordedFrame& frame, std::size_t bond, Vec2 begin, Vec2 end) {
    const double length = norm(end - begin);
    if (frame.state[bond] == static_cast<double>(BondState::broken) || length == 0.0) return std::nullopt;
    const bool broken = frame.state[bond] == static_cast<double>(BondState::touching_again);
    return FaceBand{begin, end, frame.stress_begin[bond], frame.stress_end[bond], frame.shear_force[bond] / length,
                    broken};
}

std::vector<BandPart> parts_of(const FaceBand& band, double reach) {
    const Vec2 tangent = (1.0 / norm(band.end - band.begin)) * (band.end - band.begin), normal{tangent.y, -tangent.x};
    const auto place = [&](double share) { return band.begin + share * (band.end - band.begin); };
    std::vector<BandPart> parts;
    const auto add = [&](double from, double stress_from, double to, double stress_to) {
        const bool compression = stress_from + stress_to >= 0.0;
        if (from == to || (band.broken && !compression)) return;
        const Vec2 v_from = reach * (stress_from * normal - band.shear * tangent),
                   v_to = reach * (stress_to * normal - band.shear * tangent);
        parts.push_back(
            {{place(from) + v_from, place(to) + v_to, place(to) - v_to, place(from) - v_from}, compression});
    };
    if (band.at_begin * band.at_end >= 0.0) {
        add(0.0, band.at_begin, 1.0, band.at_end);
    } else {
        const double zero = band.at_begin / (band.at_begin - band.at_end);
        add(0.0, band.at_begin, zero, 0.0);
        add(zero, 0.0, 1.0, band.at_end);
    }
    return parts;
}

double high_stress(const std::vector<const FaceBand*>& bands) {
    constexpr double exceeding = 0.02;  // fraction of the ends
    std::vector<double> stresses;
    for (const FaceBand* band : bands) {
        for (const double stress : {band->at_begin, band->at_end})
            if (stress != 0.0) stresses.push_back(std::hypot(stress, band->shear));
    }
    if (stresses.empty()) return 0.0;
    const auto at =
        stresses.begin() + static_cast<std::ptrdiff_t>((1.0 - exceeding) * static_cast<double>(stresses.size() - 1));
    std::nth_element(stresses.begin(), at, stresses.end());
    return *at;
}

}  // namespace crackle::plot
