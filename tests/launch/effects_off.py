#!/usr/bin/env python3
"""That a model that calls for no effect pays for none: tests/launch/effects_off.py [--help]

Builds the program once more without any effect (-DTRIPTYCH_EFFECTS=OFF), draws a plain pack with both programs in turn
(A/B/A/B ...), and checks that all counts and all pictures are equal, number for number and byte for byte, and that the
times of the two differ by no more than those of one program among themselves."""
import argparse
import filecmp
import json
import pathlib
import statistics
import subprocess
import sys

TIMES = {"frame_ms", "frame_cpu_ms", "frame_over_none", "effect_ms"}


def run(words, **more):
    done = subprocess.run([str(word) for word in words], text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **more)
    if done.returncode:
        sys.exit(done.stdout[-2000:] + done.stderr[-2000:])
    return done


def build(options):
    run(["cmake", "-S", options.source, "-B", options.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
         "-DTRIPTYCH_EFFECTS=OFF", "-DTRIPTYCH_TESTS=OFF", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"])
    run(["ninja", "-C", options.build, f"-j{options.jobs}", "triptych"])
    return options.build / "bin" / "triptych"


def measured(program, pack, path, options, rounds=3):
    report = options.work / "effects.json"
    run([program, "measure", "effects", pack, "--path", path, "--size", options.size, "--device", options.device,
         "--rounds", rounds, "--json", report])
    return json.loads(report.read_text())["rows"]


def counts_of(row):
    return {key: value for key, value in row.items() if key not in TIMES and key != "frames"}


def pictures(program, pack, path, folder, options):
    run([program, "render", pack, "--path", path, "--size", options.size, "--device", options.device, "-o", folder])
    return sorted(folder.glob("*.png"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    root = pathlib.Path(__file__).resolve().parents[2]
    parser.add_argument("--source", type=pathlib.Path, default=root)
    parser.add_argument("--program", type=pathlib.Path, default=root / "build/release/bin/triptych", help="the one with effects")
    parser.add_argument("--without", type=pathlib.Path, help="the one without effects, if it is built already")
    parser.add_argument("--build", type=pathlib.Path, default=root / "build/effects-off", help="the folder of the second build")
    parser.add_argument("--work", type=pathlib.Path, default=root / "out/effects-off")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--pairs", type=int, default=5, help="how often each program is measured")
    parser.add_argument("--size", default="512x512")
    parser.add_argument("--device", default="cpu", choices=["cpu", "gl"])
    parser.add_argument("--pack", type=pathlib.Path, help="a pack that calls for no effect (default: the plain twin of `sample effects`)")
    parser.add_argument("--path", type=pathlib.Path, help="its path")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    without = options.without or build(options)
    pack, path = options.pack, options.path
    if pack is None:
        scene = options.work / "scene"
        run([options.program, "sample", "effects", "-o", scene])
        pack, path = options.work / "plain.tpk", scene / "walk.json"
        run([options.program, "build", scene / "plain.gltf", "-o", pack])
        called = options.work / "scene.tpk"
        run([options.program, "build", scene / "scene.gltf", "-o", called])
        said = run([without, "render", called, "--path", path, "--frames", 1, "--size", options.size, "--device",
                    options.device, "-o", options.work / "called"]).stderr
        if "built without effects" not in said:
            sys.exit("the program without effects does not say that it draws none of a pack that calls for some")
        run([options.program, "render", called, "--path", path, "--frames", 1, "--size", options.size, "--device",
             options.device, "--effects", "none", "-o", options.work / "none"])
        if not filecmp.cmp(options.work / "called/000000.png", options.work / "none/000000.png", shallow=False):
            sys.exit("what the program without effects draws is not what --effects none draws")
    programs = {"with": options.program, "without": without}
    names = {name: pictures(program, pack, path, options.work / name, options) for name, program in programs.items()}
    same = [filecmp.cmp(a, b, shallow=False) for a, b in zip(names["with"], names["without"], strict=True)]
    print(f"pictures: {sum(same)} of {len(same)} are equal, byte for byte")
    times = {name: [] for name in programs}
    first = None
    for _ in range(options.pairs):
        for name, program in programs.items():
            rows = measured(program, pack, path, options)
            if len(rows) != 1:
                sys.exit(f"the pack calls for effects: {[row['effect'] for row in rows]}")
            first = first or counts_of(rows[0])
            if counts_of(rows[0]) != first:
                sys.exit(f"counts differ: {counts_of(rows[0])}, before {first}")
            times[name].append(rows[0]["frame_cpu_ms"]["p50"])
    print("counts, equal number for number in all runs: " + ", ".join(f"{key} {value}" for key, value in first.items() if key != "effect"))
    medians = {name: statistics.median(values) for name, values in times.items()}
    spread = max((max(values) - min(values)) / medians[name] for name, values in times.items())
    for name, values in times.items():
        print(f"{name:>8}: median {medians[name]:.3f} ms of processors a frame, from {min(values):.3f} to {max(values):.3f}")
    ratio = medians["with"] / medians["without"]
    print(f"with over without: {ratio:.3f}; runs of one program differ by up to {100 * spread:.1f} %")
    return 0 if all(same) and abs(ratio - 1) <= spread else 1


if __name__ == "__main__":
    sys.exit(main())
