// SPDX-License-Identifier: GPL-3.0-or-later
// sample_results ROOT: writes six generated results folders. One specimen has not failed, and one has a thickness and
// fragments that carry more than the specimen. One has slips, one has recorded slips without any, and one has texts
// that contain markup.
#include <fstream>
#include <iostream>

#include "tests/support/sample_results.hpp"

int main(int argc, char** argv) {
    using namespace crackle::testing;
    if (argc != 2) {
        std::cerr << "usage: sample_results ROOT\n";
        return 2;
    }
    const std::filesystem::path root = argv[1];
    write_six_sample_results(root);
    SampleTest unfinished;
    unfinished.failed = false;
    unfinished.specimen = "voronoi";
    unfinished.title = "Stopped early";
    write_sample_results(root / "stopped", unfinished);
    SampleTest rubble;
    rubble.larger_after_peak = 6.0e3;
    rubble.thickness = 0.05;
    write_sample_results(root / "rubble", rubble);
    SampleTest sliding;
    sliding.slips = true;
    sliding.specimen = "voronoi";
    write_sample_results(root / "sliding", sliding);
    write_sample_results(root / "sticking", SampleTest{});
    std::ofstream(root / "sticking" / "slips.csv")
        << "time,step,axial_strain,x,y,body_i,body_j,orientation,normal_force,shear_force\n";
    SampleTest markup;
    markup.title = "</script><script>document.title='broken out'</script> <b>bold</b> & \"quoted\"";
    write_sample_results(root / "markup", markup);
    return 0;
}
