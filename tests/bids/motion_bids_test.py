#!/usr/bin/env python3
"""motion_bids_test.py WALKTRACK SOURCE_DIR
`walktrack batch --bids` over a small data set, read by a checker of BIDS' and Motion-BIDS' rules of its own
(bids-specification: common principles, derivatives, motion, task events); the checker is shown to find faults."""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ORDER = ["sub", "ses", "task", "tracksys", "acq", "run", "recording", "desc"]  # of entities in names
COMPONENTS = {"x", "y", "z", "quat_x", "quat_y", "quat_z", "quat_w", "n/a"}
TYPES = {"ACCEL", "ANGACCEL", "GYRO", "JNTANG", "LATENCY", "MAGN", "MISC", "ORNT", "POS", "VEL"}
AXIAL = TYPES - {"JNTANG", "LATENCY", "MISC"}  # one channel for each axis
COUNTS = {t: ("ANGACC" if t == "ANGACCEL" else t) + "ChannelCount" for t in TYPES}


def rows_of(path):
    text = path.read_text(encoding="utf-8")
    assert text.endswith("\n") and "\r" not in text, f"{path.name}: lines end in a line feed"
    return [line.split("\t") for line in text[:-1].split("\n")]


def number_or_missing(cell, where):
    assert cell == "n/a" or re.fullmatch(r"-?\d+(\.\d+)?([eE][+-]?\d+)?", cell), f"{where}: '{cell}' is no number and not n/a"


def entities_of(path):
    *parts, suffix = path.name.split(".")[0].split("_")
    entities = dict(part.split("-", 1) for part in parts)
    assert len(entities) == len(parts), f"{path.name}: an entity twice"
    assert list(entities) == [key for key in ORDER if key in entities], f"{path.name}: order of entities"
    assert all(re.fullmatch(r"[0-9a-zA-Z]+", label) for label in entities.values()), f"{path.name}: labels"
    return entities, suffix


def check_place(path, root):
    entities, _ = entities_of(path)
    wanted = ["sub-" + entities["sub"], *(["ses-" + entities["ses"]] if "ses" in entities else []), "motion"]
    assert list(path.parent.relative_to(root).parts) == wanted, f"{path}: folder"
    for entity in ("task", "tracksys"):
        assert entity in entities, f"{path.name}: no {entity}"
    assert "desc" in entities, f"{path.name}: a derived file under a name that may be recorded"


def check_channels(path):
    header, *rows = rows_of(path)
    assert header[:5] == ["name", "component", "type", "tracked_point", "units"], f"{path.name}: columns {header}"
    assert len(set(header)) == len(header), f"{path.name}: a column twice"
    names = [row[0] for row in rows]
    assert len(set(names)) == len(names), f"{path.name}: a channel twice"
    for row in rows:
        assert len(row) == len(header) and all(row), f"{path.name}: cells of {row}"
        name, component, kind = row[:3]
        assert component in COMPONENTS, f"{path.name}: component {component}"
        assert kind in TYPES, f"{path.name}: type {kind}"
        assert kind not in AXIAL or component in "xyz", f"{path.name}: {name} has no axis"
        assert kind != "JNTANG" or row[4] == "deg", f"{path.name}: {name} in {row[4]}"
        assert kind != "POS" or row[4] == "m", f"{path.name}: {name} in {row[4]}"
    frames = json.loads(path.with_suffix(".json").read_text())["reference_frame"]["Levels"]
    column = header.index("reference_frame")
    assert {row[column] for row in rows} <= set(frames) | {"n/a"}, f"{path.name}: reference frames"
    for frame in frames.values():
        assert frame.get("RotationRule", "right-hand") in ("right-hand", "left-hand")
        assert "Description" in frame or "SpatialAxes" in frame
    return rows


def check_motion(path, root):
    check_place(path, root)
    entities, _ = entities_of(path)
    stem = path.name.removesuffix("_motion.tsv")
    side = json.loads(path.with_suffix(".json").read_text())
    channels = check_channels(path.with_name(stem + "_channels.tsv"))
    for key, kind in {"TaskName": str, "TrackingSystemName": str, "SamplingFrequency": (int, float)}.items():
        assert isinstance(side.get(key), kind), f"{stem}: {key}"
    assert side["TrackingSystemName"] == entities["tracksys"], f"{stem}: TRACKSYS_MISMATCH"
    assert re.sub(r"[^0-9a-zA-Z]", "", side["TaskName"]) == entities["task"], f"{stem}: TaskName"
    assert side["SamplingFrequency"] > 0
    for kind in TYPES:
        count = sum(row[2] == kind for row in channels)
        assert side.get(COUNTS[kind], count) == count, f"{stem}: {COUNTS[kind]}"
    assert side["MotionChannelCount"] == len(channels), f"{stem}: MotionChannelCount"
    points = {row[3] for row in channels if row[2] == "POS"}
    assert side["TrackedPointsCount"] == len(points), f"{stem}: TrackedPointsCount"
    for point in points:
        axes = sorted(row[1] for row in channels if row[3] == point and row[2] == "POS")
        assert axes == ["x", "y", "z"], f"{stem}: axes of {point}"
    rows = rows_of(path)  # without a header
    for row in rows:
        assert len(row) == len(channels), f"{path.name}: {len(row)} columns, {len(channels)} channels"
        for cell in row:
            number_or_missing(cell, path.name)
    assert abs(side["RecordingDuration"] - len(rows) / side["SamplingFrequency"]) < 1e-6, f"{stem}: RecordingDuration"
    assert side["MissingValues"] == "n/a"
    return rows, channels, side


def check_events(path, root):
    check_place(path, root)
    header, *rows = rows_of(path)
    assert header[:2] == ["onset", "duration"], f"{path.name}: columns {header}"
    said = json.loads(path.with_suffix(".json").read_text())
    assert set(said) <= set(header) and set(header) <= set(said), f"{path.name}: columns that are not described"
    onsets = []
    for row in rows:
        assert len(row) == len(header) and all(row)
        number_or_missing(row[0], path.name)
        onsets.append(float(row[0]))
        assert row[1] == "n/a" or float(row[1]) >= 0, f"{path.name}: duration"
        for name in ("trial_type", "side"):
            assert row[header.index(name)] in said[name]["Levels"], f"{path.name}: {name}"
    assert onsets == sorted(onsets), f"{path.name}: order of onsets"
    return rows


def check_description(root, raw):
    about = json.loads((root / "dataset_description.json").read_text())
    for key in ("Name", "BIDSVersion"):
        assert about[key]
    assert tuple(map(int, about["BIDSVersion"].split("."))) >= (1, 9, 0), "motion came with 1.9.0"
    assert about["DatasetType"] == "derivative" and about["GeneratedBy"][0]["Name"] == "walktrack"
    assert (root / about["DatasetLinks"]["raw"]).resolve() == raw.resolve()


def check_data_set(root, raw):
    """Every file is BIDS', or ignored; what was found."""
    check_description(root, raw)
    ignored = (root / ".bidsignore").read_text().split()
    assert "results/" in ignored
    found = {}
    for path in sorted(root.rglob("*")):
        parts = path.relative_to(root).parts
        if path.is_dir() or path.name.startswith(".") or parts[0] + "/" in ignored or parts[-1] in ignored:
            continue
        if parts == ("dataset_description.json",):
            continue
        check_place(path, root)
        _, suffix = entities_of(path)
        assert suffix in ("motion", "channels", "events") and path.suffix in (".tsv", ".json"), path
        if path.name.endswith("_motion.tsv"):
            rows, channels, side = check_motion(path, root)
            (source,) = side["Sources"]
            assert (raw / source.removeprefix("bids:raw:")).is_file(), source
            found[path.name] = rows, channels
        if path.name.endswith("_events.tsv"):
            check_events(path, root)
            assert path.with_name(path.name.replace("_events.tsv", "_motion.tsv")).exists()
    return found


def make_data_set(run, work):
    """Two subjects, one of them with sessions; a background that is no recording; a video of another kind."""
    (work / "walk.yaml").write_text(
        "frame_rate: 15\nduration: 1.6\ninitial: true\nbackground_frames: 5\nwalk: {speed: 1.2, start: [-0.8, 0]}\n"
        "cameras: [{name: side, azimuth_deg: -90, distance: 4, size: [96, 72]}]\n")
    run("render", "--options", work / "walk.yaml", "-o", work / "made")
    raw = work / "data"
    for name in ("sub-01/beh/sub-01_task-walk_run-1_video.mp4", "sub-01/beh/sub-01_task-walk_run-2_video.mp4",
                 "sub-02/ses-pre/sub-02_ses-pre_task-walk_video.mp4", "sub-02/ses-pre/sub-02_ses-pre_task-walk_bg.mp4",
                 "sourcedata/sub-03/sub-03_task-walk_video.mp4"):
        (raw / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(work / "made/side.mp4", raw / name)
    (raw / "dataset_description.json").write_text('{"Name": "Walks", "BIDSVersion": "1.9.0"}\n')
    return raw


def check_values(root, found):
    """The numbers are those of the result folders, in the order that the channels say."""
    for name, (rows, channels) in found.items():
        entities = [e for e in name.removesuffix("_motion.tsv").split("_") if not e.startswith(("tracksys-", "desc-"))]
        result = root / "results" / "_".join(entities)
        for table, ending in (("joints.csv", ""), ("angles.csv", "_deg")):
            header, *lines = [line.split(",") for line in (result / table).read_text().splitlines()]
            assert len(lines) == len(rows), name
            for k, channel in enumerate(channels):
                if (channel[2] == "POS") != (ending == ""):
                    continue
                column = header.index(channel[0] + ending)
                assert [row[k] for row in rows] == [line[column] or "n/a" for line in lines], (name, channel)


def change(pattern, old, new):
    def spoil(root):
        path = next(root.rglob(pattern))
        text = path.read_text()
        assert old in text, (path, old)
        path.write_text(text.replace(old, new, 1))
    return spoil


FAULTS = {
    "a header row": lambda root: (p := next(root.rglob("*_motion.tsv"))).write_text("pelvis_x\tpelvis_y\n" + p.read_text()),
    "another name of the system": change("*_motion.json", '"TrackingSystemName": "walktrack"', '"TrackingSystemName": "other"'),
    "a count": change("*_motion.json", '"POSChannelCount": ', '"POSChannelCount": 1'),
    "an unknown type": change("*_channels.tsv", "\tPOS\t", "\tpos\t"),
    "a column too few": change("*_channels.tsv", "pelvis_x\tx\tPOS\tpelvis\tm\tglobal\n", ""),
    "an empty cell": change("*_motion.tsv", "\t", "\t\t"),
    "no onset": change("*_events.tsv", "onset", "time"),
    "a raw name": lambda root: (p := next(root.rglob("*_motion.tsv"))).rename(p.with_name(p.name.replace("_desc-tracked", ""))),
    "a raw data set": change("dataset_description.json", '"derivative"', '"raw"'),
}


def main():
    walktrack, source = sys.argv[1], pathlib.Path(sys.argv[2])

    def run(*words, allowed=(0, 4)):
        done = subprocess.run([walktrack, *map(str, words)], capture_output=True, text=True)
        assert done.returncode in allowed, f"{words}: {done.returncode} {done.stderr}"
        return done

    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        raw = make_data_set(run, work)
        batch = ("batch", raw, "--bids", "--scene", work / "made/scene.yaml", "--threads", "1", "--quiet",
                 "--set", "filter.particles=20", "-c", source / "tests/any_quality.yaml")
        run(*batch)
        root = raw / "derivatives/walktrack"
        found = check_data_set(root, raw)
        assert sorted(found) == ["sub-01_task-walk_tracksys-walktrack_run-1_desc-tracked_motion.tsv",
                                 "sub-01_task-walk_tracksys-walktrack_run-2_desc-tracked_motion.tsv",
                                 "sub-02_ses-pre_task-walk_tracksys-walktrack_desc-tracked_motion.tsv"], sorted(found)
        check_values(root, found)
        before = {p: p.read_bytes() for p in root.rglob("*_motion.*")}
        run(*batch)  # again: nothing to do, the same tables
        assert before == {p: p.read_bytes() for p in root.rglob("*_motion.*")}
        for fault, spoil in FAULTS.items():
            broken = work / "data2/derivatives/walktrack"
            shutil.copytree(raw, work / "data2")
            spoil(broken)
            try:
                check_data_set(broken, work / "data2")
            except (AssertionError, KeyError, ValueError):
                pass
            else:
                raise SystemExit(f"the checker does not see {fault}")
            shutil.rmtree(work / "data2")
        # A result that is no more takes its tables along; the others stay.
        shutil.rmtree(root / "results/sub-01_task-walk_run-2")
        run(*batch, "--report", allowed=(1,))
        assert len(check_data_set(root, raw)) == 2
        for name, message in {"sub-01/sub-01_run-1_video.mp4": "without task-", "sub-01/sub-02_task-a_video.mp4": "folder's"}.items():
            shutil.copy(work / "made/side.mp4", raw / name)
            assert message in run(*batch, allowed=(3,)).stderr
            (raw / name).unlink()
    print(f"{len(found)} recordings as Motion-BIDS, {len(FAULTS)} faults seen")


if __name__ == "__main__":
    main()
