// SPDX-License-Identifier: GPL-3.0-or-later
// The table of the commands of `crackle`.

#include "tools/commands/commands.hpp"

namespace crackle::tools {

const std::vector<Command>& commands() {
    static const std::vector<Command> all{
        {"pack", "packs random circles in a box to equilibrium and writes in_gm.dat", describe_pack, pack},
        {"mesh", "makes polygon particles from a packing or a list of centres", describe_mesh, mesh},
        {"joints", "generates or reads joint traces, and prints their intensities, directions and blocks",
         describe_joints, joints},
        {"run", "runs a DEMseg deck (in_gm.dat, in_bc.dat) and writes DEMseg's output files", describe_run, run_deck},
        {"test", "makes and loads one bonded specimen, and writes curve, events, summary and frames", describe_test,
         test},
        {"elastic", "computes moduli, first break and slip, and stable time step of a specimen by a linear solve",
         describe_elastic, elastic},
        {"campaign", "runs a table of tests on all processors or a cluster, and computes means and scatter",
         describe_campaign, campaign, campaign_studies},
        {"envelope", "fits Mohr-Coulomb and Hoek-Brown laws to strengths under several confining pressures",
         describe_envelope, envelope},
        {"calibrate", "finds values of a rock's keys that reproduce laboratory results", describe_calibrate,
         calibrate_rock},
        {"report", "makes one self-contained HTML page from the results of tests", describe_report, report},
        {"view", "makes a page that shows a particle file, a deck run or tests in motion", describe_view, view},
        {"plot", "draws figures for papers (curves, breaks, specimens) as SVG, PDF or PNG", describe_plot, plot},
        {"bench", "starts crackle-bench, a separate program with studies of the engine", describe_bench, bench},
        {"doctor", "prints the components and capabilities of this build", describe_doctor, doctor},
        {"completion", "prints a script with which bash, zsh or fish completes commands and options",
         describe_completion, completion},
        {"man", "prints the manual page", describe_manual, manual},
    };
    return all;
}

}  // namespace crackle::tools
