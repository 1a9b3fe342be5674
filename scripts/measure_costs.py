#!/usr/bin/env python3
"""Fits the coefficients of the cost model (lib/jobs/plan/cost_model.h) and prints them as its source has them.

    scripts/measure_costs.py WALKTRACK OUT

Renders one walk with three cameras and tracks a short and a long part of it on one thread with one setting after the
other. The difference of the CPU seconds of each stage, which excludes the start, is explained by the counts of
`walktrack plan --json` for the same setting, and by the number of poses that were in fact evaluated: least squares of
relative errors, no coefficient below zero. The last line states the errors of the fitted model over the settings. What is
in OUT already is not repeated. Standard library only.
"""
import json
import pathlib
import statistics
import sys

from measure_gait import OTHERS, SIDE, run

OPTIONS = f"""frame_rate: 30
duration: 2.2
walk: {{speed: 1.25, start: [-1.3, 0], phase: 0.2}}
initial: true
background_frames: 10
cameras:
  - {SIDE}
  - {OTHERS[0]}
  - {OTHERS[1]}
"""
SHORT, LONG = 24, 64  # frames tracked of it
# Every stage of the work weighs much in some of these.
SETTINGS = [("particles=40", "cameras=3"), ("particles=120", "cameras=1"), ("particles=40", "cameras=1"),
            ("particles=300", "cameras=1", "moves=0"), ("particles=60", "cameras=2", "moves=1"),
            ("particles=40", "cameras=2", "arms=true"), ("particles=60", "cameras=1", "scale=60"),
            ("particles=40", "cameras=3", "scale=60"), ("particles=60", "cameras=1", "scale=240"),
            ("particles=40", "cameras=2", "terms=background+foreground"), ("particles=60", "cameras=1", "terms=background"),
            ("particles=60", "cameras=3", "terms=background"), ("particles=60", "cameras=2", "terms=flow"), ("particles=200", "cameras=2", "moves=0", "terms=background+flow"),
            ("particles=40", "cameras=1", "arms=true", "scale=240", "terms=background+foreground")]
KEYS = {"particles": ["filter.particles"], "moves": ["filter.moves"], "scale": ["observation.person_px"], "arms": ["body.arms"]}
PART_POSED_NS = 60  # of a profile: these videos cannot tell it from projecting
PASSED = 0.57  # of the moves, by the first camera; counted in runs with three (kPassed of the cost model)
TERMS = ("background", "foreground", "flow")


def settings(words):
    for word in words:
        name, value = word.split("=")
        if name == "terms":
            for term in TERMS:
                yield from ("--set", f"observation.{term}.enabled={'true' if term in value else 'false'}")
        elif name != "cameras":
            yield from ("--set", f"{KEYS[name][0]}={value}")
        if name == "particles":  # the first half second, too
            yield from ("--set", f"start.particles={value}")


def scene_of(walktrack, out, cameras, frames):
    full = out / "scene" / "scene.yaml"
    if not full.exists():
        out.mkdir(parents=True, exist_ok=True)
        (out / "options.yaml").write_text(OPTIONS)
        run(walktrack, "render", "--options", out / "options.yaml", "-o", out / "scene", "-y")
    file = out / "scene" / f"scene_{cameras}_{frames}.yaml"
    dropped = ["name: front", "name: back"][cameras - 1:]
    lines = [line for line in full.read_text().splitlines() if not any(name in line for name in dropped)]
    file.write_text("\n".join([*lines, f"last_frame: {frames - 1}"]) + "\n")
    return file


def measured(walktrack, out, words):
    """The records of the short and the long piece, and the plan."""
    options, records = list(settings(words)), []
    for frames in (SHORT, LONG):
        scene = scene_of(walktrack, out, int(dict(word.split("=") for word in words)["cameras"]), frames)
        folder = out / "runs" / ",".join((*words, str(frames)))
        if not (folder / "run.json").exists():
            run(walktrack, "track", scene, "-o", folder, "-y", "--no-overlay", "--threads", 1, *options, allowed=(0, 4))
        records.append(json.loads((folder / "run.json").read_text()))
    return *records, json.loads(run(walktrack, "plan", scene, "--json", *options))


def features(before, record, plan):
    """For each stage the CPU ns of a frame and the counts that explain it."""
    config = record["config"]
    images, layers = config["observation"], [n for n in record["by_frame"]["layers"][SHORT:] if n]
    # The last layer is not followed by moves unless it is resampled, which it nearly always is.
    poses = config["filter"]["particles"] * (1 + statistics.mean(layers) * config["filter"]["moves"])
    # Moves that the first camera is against are not put to the others.
    others = config["filter"]["particles"] + PASSED * (poses - config["filter"]["particles"])
    asked = [poses] + [others] * (len(plan["cameras"]) - 1)
    region, parts = sum(c["region_px"] for c in plan["cameras"]), plan["work"]["parts"]
    rows = sum(n * c["rows"] for n, c in zip(asked, plan["cameras"]))
    flow, silhouettes = images["flow"]["enabled"] == "on", images["background"]["enabled"] or images["foreground"]["enabled"]
    seconds = [r["timing"]["stage_cpu_seconds"] for r in (before, record)]
    ns = {stage: 1e9 * (s - seconds[0].get(stage, 0)) / (LONG - SHORT) for stage, s in seconds[1].items()}
    filmed = sum(c["size_px"][0] * c["size_px"][1] for c in plan["cameras"])
    return {
        "decode": (ns["decode"], {"kDecoding": filmed}),
        "evidence": (ns["evidence"] + ns.get("appearance", 0), {"kDecoding2": filmed, "kBackground": region * images["background"]["enabled"],
                                       "kAppearance": plan["work"]["classes"] * len(plan["cameras"]), "kFlowMeasured": region * flow}),
        "filter": (ns["filter"] - PART_POSED_NS * poses * parts, {"kWalker": config["filter"]["particles"],
                                  "kPartProjected": sum(asked) * parts, "kRowSummed": rows * silhouettes, "kFrame": 1,
                                  "kFlowWeighed": sum(asked) * parts * flow}),
    }, statistics.mean(layers)


def fitted(samples):
    """Coefficients >= 0 that minimise the squares of relative errors, by coordinates."""
    names = sorted({name for _, made_of in samples for name in made_of})
    rows = [([made_of.get(name, 0) / ns for name in names], 1.0) for ns, made_of in samples]
    values = [0.0] * len(names)
    for _ in range(20000):
        for k in range(len(names)):
            square = sum(row[k] ** 2 for row, _ in rows)
            rest = sum(row[k] * (y - sum(v * f for j, (v, f) in enumerate(zip(values, row)) if j != k)) for row, y in rows)
            values[k] = max(0.0, rest / square) if square else 0.0
    return dict(zip(names, values))


def main():
    walktrack, out = sys.argv[1], pathlib.Path(sys.argv[2])
    stages, layers, totals = {}, {}, []
    for number, words in enumerate(SETTINGS, 1):
        print(f"{number}/{len(SETTINGS)} {' '.join(words)}", file=sys.stderr)
        by_stage, mean_layers = features(*measured(walktrack, out, words))
        for stage, sample in by_stage.items():
            stages.setdefault(stage, []).append(sample)
        layers.setdefault(words[1], []).append(mean_layers)
        totals.append(by_stage)
    found = {name: value for samples in stages.values() for name, value in fitted(samples).items()}
    off = [abs(sum(found[n] * x for _, made_of in one.values() for n, x in made_of.items()) / sum(ns for ns, _ in one.values()) - 1) for one in totals]
    found["kDecoding"] += found.pop("kDecoding2")
    for name, value in {**found, "kPartPosed": PART_POSED_NS}.items():
        print(f"constexpr double {name} = {value:.3g};")
    print("layers:", {cameras: round(statistics.median(values), 1) for cameras, values in sorted(layers.items())})
    worst = " ".join(SETTINGS[off.index(max(off))])
    print(f"off by {100 * statistics.median(off):.0f} % (median), {100 * max(off):.0f} % (worst: {worst})")


main()
