# All readers of files, inside and outside the solver. tests/fuzz and tools/test --sanitize compile them with
# sanitizers; the rest of specimens/ is linked from the release build.
set(readers
    solver/demseg/boundary.cpp solver/demseg/contact_files.cpp solver/demseg/deck_reader.cpp solver/demseg/deck_run.cpp
    solver/demseg/deck_folder.cpp
    solver/demseg/deck_state.cpp solver/demseg/geometry.cpp solver/demseg/outputs.cpp solver/demseg/read_outputs.cpp
    solver/demseg/circle_list.cpp solver/files/file_kind.cpp solver/files/file_set.cpp solver/files/read_file.cpp
    solver/files/table_reader.cpp solver/files/text_lines.cpp solver/world/checkpoint.cpp
    specimens/case/case_file.cpp specimens/case/consistency.cpp specimens/case/joint_checks.cpp specimens/case/mineral_checks.cpp specimens/case/resolve.cpp specimens/case/test_case.cpp
    specimens/case/keyed_table.cpp specimens/case/toml_file.cpp specimens/case/toml_shape.cpp
    specimens/calibration/rock.cpp specimens/campaign/axis.cpp specimens/campaign/ledger.cpp specimens/campaign/ledger_failure.cpp specimens/campaign/ledger_hashes.cpp
    specimens/campaign/plan.cpp specimens/campaign/plan_file.cpp specimens/campaign/point_table.cpp specimens/envelope/measured_strengths.cpp
    specimens/frames/base64.cpp specimens/frames/read_frames.cpp
    specimens/joints/trace_files.cpp
    specimens/making/label_image.cpp specimens/making/minerals.cpp
    specimens/packing/packing_text.cpp specimens/packing/size_distribution.cpp
    specimens/recordings/deck_recording.cpp specimens/recordings/measured_curve.cpp specimens/recordings/recording.cpp specimens/recordings/test_recording.cpp
    specimens/recordings/stated_files.cpp specimens/recordings/test_results.cpp
    specimens/results/checkpoint.cpp specimens/summary/summary_file.cpp specimens/summary/summary_keys.cpp
    tools/commands/centre_list.cpp)
