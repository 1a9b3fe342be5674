#!/usr/bin/env python3
"""Fits the weights of the likelihood's terms on one set of scenes and quotes them on another.

    scripts/fit_weights.py WALKTRACK OUT --fit FOLDER ... --quote FOLDER ... --over KEY=V:V:... [KEY=V:V:... ...]
                           [--scene NAME] [--seeds N] [--jobs N] [-- OPTIONS OF TRACK ...]

Below each FOLDER every scene with a truth is taken, or only those whose file is named NAME, for example scene_one_camera.yaml.
Each KEY is a number of `walktrack config`, such as observation.outline_share, and is asked in turn, with the keys before it at their
best values: every value is tried on the scenes of --fit, beside the defaults. A value is taken only if it lowers the fitted number
by more than the defaults' own scatter, which is estimated from the seeds; so a difference that another choice of seeds would undo
changes nothing. The fitted number is the mean over scenes of the median error of their seeds, mm. Then the defaults and what was
chosen are tracked on the scenes of --quote, which no choice has seen. Errors are those of scripts/measure_gates.py. Prints Markdown
tables; what OUT holds already is not done again, so that a fit that was stopped goes on. Standard library only.
"""
import argparse
import concurrent.futures
import hashlib
import pathlib
import random
import statistics
import sys

from measure_gates import measured, scenes_below, truth_of

LOST_MM = 1000  # the error of a run that tracked nothing
RESAMPLED = 200


def parsed():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("walktrack", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--fit", nargs="+", type=pathlib.Path, required=True)
    parser.add_argument("--quote", nargs="+", type=pathlib.Path, required=True)
    parser.add_argument("--over", nargs="+", required=True)
    parser.add_argument("--scene")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--jobs", type=int, default=1)
    words, options = sys.argv[1:], []
    if "--" in words:
        words, options = words[:words.index("--")], words[words.index("--") + 1:]
    return parser.parse_args(words), options


def scenes_of(folders, name):
    found = [file for folder in folders for _, file in scenes_below(folder) if name in (None, file.name) and truth_of(file)]
    if not found:
        sys.exit(f"no scene with a truth{f' named {name}' if name else ''} below {', '.join(map(str, folders))}")
    return found


def label(settings):
    return ", ".join(f"{key}={value}" for key, value in settings.items()) or "defaults"


class Tracker:
    def __init__(self, arguments, options):
        self.walktrack, self.out, self.options = arguments.walktrack.resolve(), arguments.out, options
        self.seeds, self.jobs = range(1, arguments.seeds + 1), arguments.jobs

    def run(self, scene, seed, settings):
        of_settings = hashlib.sha256(label(settings).encode()).hexdigest()[:12]
        folder = self.out / of_settings / "_".join(scene.resolve().parts[1:]) / str(seed)
        words = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
        result = measured(self.walktrack, scene, seed, folder, [*words, *self.options])
        return {"mm": LOST_MM if result["mm"] is None else result["mm"], "green": result["green"], "wrong": result["wrong"]}

    def errors(self, scenes, settings):
        """The runs of each scene."""
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            work = {(scene, seed): pool.submit(self.run, scene, seed, settings) for scene in scenes for seed in self.seeds}
        print(f"{label(settings)}: done", file=sys.stderr, flush=True)
        return [[work[scene, seed].result() for seed in self.seeds] for scene in scenes]


def typical(runs_by_scene):
    return statistics.mean(statistics.median(run["mm"] for run in runs) for runs in runs_by_scene)


def scatter(runs_by_scene):
    """Standard deviation of that number if the seeds had been others: seeds drawn anew from those there are."""
    draw = random.Random(1)
    return statistics.stdev(typical([draw.choices(runs, k=len(runs)) for runs in runs_by_scene]) for _ in range(RESAMPLED))


def row(settings, runs_by_scene):
    runs = [run for each in runs_by_scene for run in each]
    return (f"| {label(settings)} | {typical(runs_by_scene):.1f} | {max(run['mm'] for run in runs):.0f} | "
            f"{sum(run['wrong'] for run in runs)} | {sum(run['green'] for run in runs)} of {len(runs)} |")


def head(title):
    print(f"\n{title}\n\n| settings | mean of medians, mm | worst run, mm | wrong | green |\n|---|---:|---:|---:|---:|")


def main():
    arguments, options = parsed()
    tracker = Tracker(arguments, options)
    fitted, quoted = scenes_of(arguments.fit, arguments.scene), scenes_of(arguments.quote, arguments.scene)
    shared = {file.resolve() for file in fitted} & {file.resolve() for file in quoted}
    if shared:
        sys.exit(f"{sorted(shared)[0]} is in both sets")
    best = {}
    runs = tracker.errors(fitted, best)
    least, noise = typical(runs), scatter(runs)
    head(f"Fitted on {len(fitted)} scenes, seeds 1 to {arguments.seeds}; a gain below {noise:.1f} mm is none")
    print(row(best, runs))
    for choice in arguments.over:
        key, values = choice.split("=")
        before = dict(best)
        for value in values.split(":"):
            tried = {**before, key: value}
            runs = tracker.errors(fitted, tried)
            print(row(tried, runs), flush=True)
            if typical(runs) < least - noise:
                least, best = typical(runs), tried
    print(f"\nChosen: {label(best)}")
    head(f"Quoted on {len(quoted)} other scenes, seeds 1 to {arguments.seeds}")
    for settings in ({}, best) if best else ({},):
        print(row(settings, tracker.errors(quoted, settings)))


if __name__ == "__main__":
    main()
