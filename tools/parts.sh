#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Functions for long checks in several parts, sourced by .ci/run and tools/test. Each part is timed; if one fails, the others
# still run.
#   part TITLE COMMAND...    runs a part
#   all_parts_passed         prints the outcome and duration of each part; fails if any part failed
parts=() times=() outcomes=() failed=0
part() {
    local title=$1 started=$SECONDS code=0
    shift
    printf '\n==== %s: %s\n' "$title" "$*"
    "$@" </dev/null || code=$?
    parts+=("$title")
    times+=("$((SECONDS - started))")
    if [ "$code" -eq 0 ]; then outcomes+=(passed); else
        outcomes+=("FAILED ($code)")
        failed=1
    fi
    printf '==== %s: %s in %d s\n' "$title" "${outcomes[-1]}" "${times[-1]}"
}

all_parts_passed() {
    local k
    echo
    for k in "${!parts[@]}"; do printf '%-12s %-12s %5d s\n' "${parts[k]}" "${outcomes[k]}" "${times[k]}"; done
    printf '%-12s %-12s %5d s\n\n' total '' "$SECONDS"
    [ "$failed" -eq 0 ]
}
