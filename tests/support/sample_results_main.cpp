// SPDX-License-Identifier: GPL-3.0-or-later
// sample_results ROOT: six made-up folders of results. One has not failed; one has a thickness, and pieces that carry
// more than the specimen. One has slips, one recorded slips and had none, and one has texts that try to be markup.
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
