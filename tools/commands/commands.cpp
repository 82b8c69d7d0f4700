// SPDX-License-Identifier: GPL-3.0-or-later
// The table of the commands of `crackle`.

#include "tools/commands/commands.hpp"

namespace crackle::tools {

const std::vector<Command>& commands() {
    static const std::vector<Command> all{
        {"pack", "random circles in a box, compressed to equilibrium: in_gm.dat", describe_pack, pack},
        {"mesh", "polygon particles from a packing or a list of seeds: in_gm_tri.dat, in_gm_volo.dat", describe_mesh,
         mesh},
        {"joints", "traces of joints, generated from sets or read from files: amounts, directions, blocks, a figure",
         describe_joints, joints},
        {"run", "runs a DEMseg deck (in_gm.dat, in_bc.dat) and writes DEMseg's output files", describe_run, run_deck},
        {"test", "one virtual test: specimen, bonding, platens, loading; curve, events, summary, frames", describe_test,
         test},
        {"elastic", "the same specimen by a sparse linear solve: moduli, first break and slip, stable time step",
         describe_elastic, elastic},
        {"campaign", "a table of tests on all processors or a cluster: means, scatter, bias", describe_campaign,
         campaign, campaign_studies},
        {"envelope", "strength against confinement: Mohr-Coulomb, Hoek-Brown, with intervals and Mohr circles",
         describe_envelope, envelope},
        {"calibrate", "calibrates a rock's keys from laboratory values: cases, intervals, unreachable targets",
         describe_calibrate, calibrate_rock},
        {"report", "one self-contained HTML page from the results of tests", describe_report, report},
        {"view", "a page that shows a particle file, a deck run or tests in motion", describe_view, view},
        {"plot", "figures for papers: curves, breaks, specimens, as SVG, PDF or PNG", describe_plot, plot},
        {"bench", "starts crackle-bench, a separate program with studies of the engine", describe_bench, bench},
        {"doctor", "components and capabilities of this build", describe_doctor, doctor},
        {"completion", "a script with which bash, zsh or fish completes commands and options", describe_completion,
         completion},
        {"man", "the manual page", describe_manual, manual},
    };
    return all;
}

}  // namespace crackle::tools
