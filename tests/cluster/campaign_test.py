#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests a campaign on Slurm: cancelled half-way, submitted again and gathered twice, it gives the same bytes as on one machine.

    tests/cluster/campaign_test.py CRACKLE [--tests N] [--shards K]

Starts a cluster that consists of this machine (tests/cluster/slurm); if that is not possible, prints the reason and exits with 77.
"""
import argparse
import os
import pathlib
import sqlite3
import subprocess
import sys
import tempfile
import time

PLAN = """[[test]]
case = "{case}"
set = {{"packing.count" = 60}}
[[axis]]
key = "material.friction_angle"
values = [20.0, 35.0]
[packings]
count = {packings}
"""
CASE = pathlib.Path(__file__).resolve().parents[2] / "specimens" / "guide_rock" / "circles_tension.toml"


def called(*words):
    return subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True).stdout


def ended(folder):
    """Number of tests that the shares have run so far."""
    count = 0
    for file in folder.glob("shards/*.sqlite"):
        try:
            with sqlite3.connect(f"file:{file}?mode=ro", uri=True, timeout=10) as ledger:
                count += ledger.execute("SELECT count(*) FROM test").fetchone()[0]
        except sqlite3.OperationalError:
            pass  # the ledger does not exist yet
    return count


def wait_for_jobs():
    while called("squeue", "-h").strip():
        time.sleep(1)


def on_the_cluster(crackle, tests, shards):
    with tempfile.TemporaryDirectory() as scratch:
        here = pathlib.Path(scratch)
        plan, shared, whole = here / "plan.toml", here / "shared", here / "whole"
        plan.write_text(PLAN.format(case=CASE, packings=tests // 2))
        begun = time.time()
        called(crackle, "campaign", str(plan), "-o", str(whole), "-q")
        alone = time.time() - begun
        expected = called(crackle, "campaign", "show", str(whole), "--tests")

        begun = time.time()
        submit = (crackle, "campaign", "submit", str(plan), "-o", str(shared), "--shards", str(shards), "-q")
        called(*submit)
        while ended(shared) < tests // 2 and called("squeue", "-h").strip():
            time.sleep(0.2)
        called("scancel", "-u", "root")
        wait_for_jobs()
        half = ended(shared)
        called(*submit)
        wait_for_jobs()
        first = called(crackle, "campaign", "gather", str(shared))
        second = called(crackle, "campaign", "gather", str(shared))
        got = called(crackle, "campaign", "show", str(shared), "--tests")
        print(f"{tests} tests in {shards} shares: cancelled after {half}, then {first.strip()}; again: {second.strip()}")
        print(f"one machine {alone:.1f} s, the cluster {time.time() - begun:.1f} s; tables of {len(got)} bytes "
              f"{'equal' if got == expected else 'DIFFER'}")
        for log in sorted(shared.glob("shards/*.log")):
            if log.read_text().strip():
                print(log.name, log.read_text())
        assert 0 < half < tests, "it was not cancelled half-way"
        assert second.startswith("0 tests from"), second
        assert got == expected


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("crackle")
    parser.add_argument("--tests", type=int, default=40)
    parser.add_argument("--shards", type=int, default=4)
    given = parser.parse_args()
    crackle = os.path.abspath(given.crackle)
    if "CRACKLE_TEST_CLUSTER" in os.environ:
        on_the_cluster(crackle, given.tests, given.shards)
        return 0
    cluster = pathlib.Path(__file__).resolve().parent / "slurm"
    return subprocess.run([str(cluster), sys.executable, __file__, crackle, "--tests", str(given.tests), "--shards",
                           str(given.shards)]).returncode


if __name__ == "__main__":
    sys.exit(main())
