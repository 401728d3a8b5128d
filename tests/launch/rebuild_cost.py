#!/usr/bin/env python3
"""What a rebuild costs after one of the files of a model has changed: tests/launch/rebuild_cost.py [--help]

A house of several storeys, each of which is two files: the building itself with its furniture, and its services. Each
row is one build with a cache that holds the first revision, in seconds of processor time, and its share of a build of
the same files from nothing; the packs of both must be equal. The share of a file that is replaced is what a build from
nothing takes less without it."""
import argparse
import filecmp
import json
import pathlib
import resource
import shutil
import subprocess
import sys

STOREY = 4.5  # metres


class House:
    def __init__(self, options):
        self.program, self.work = options.program, options.work
        self.furniture = options.furniture
        self.work.mkdir(parents=True, exist_ok=True)

    def run(self, words):
        """Returns the seconds of processor time that the command took."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([self.program, *map(str, words)], capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def file(self, kind, storey, seed):
        """A sample that was lifted to its storey; made once."""
        folder = self.work / f"{kind}-{storey}-{seed}"
        scene = folder / "scene.gltf"
        if scene.exists():
            return scene
        size = ["--floors", 1, "--furniture", self.furniture] if kind == "building" else ["--storeys", 1]
        self.run(["sample", kind, "-o", folder, "--seed", seed, *size])
        model = json.loads(scene.read_text())
        roots = model["scenes"][model.get("scene", 0)]["nodes"]
        model["nodes"].append({"children": list(roots), "translation": [0, STOREY * storey, 0]})
        roots[:] = [len(model["nodes"]) - 1]
        scene.write_text(json.dumps(model))
        return scene

    def build(self, files, pack, cache=None):
        """Seconds, and what --json says."""
        words = ["build", *files, "-o", self.work / pack, "--json", self.work / "build.json"]
        if cache:
            words += ["--cache", self.work / cache]
        seconds = self.run(words)
        return seconds, json.loads((self.work / "build.json").read_text())


def renamed(file):
    other = file.with_name("renamed.gltf")
    shutil.copyfile(file, other)
    return other


def added_to(file):
    """The same with its last object placed once more, 0.73 m aside."""
    model = json.loads(file.read_text())
    nodes = model["nodes"]
    last = max(i for i, node in enumerate(nodes) if "mesh" in node)
    again = dict(nodes[last])
    nodes.append(again)
    nodes.append({"children": [len(nodes) - 1], "translation": [0.73, 0, 0]})
    parent = next((node for node in nodes if last in node.get("children", [])), nodes[-3])
    parent["children"].append(len(nodes) - 1)
    other = file.with_name("added.gltf")
    other.write_text(json.dumps(model))
    return other


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/bin/triptych")
    parser.add_argument("--work", type=pathlib.Path, required=True, help="folder for samples and packs")
    parser.add_argument("--storeys", type=int, default=5)
    parser.add_argument("--furniture", type=int, default=400, help="pieces of a storey")
    parser.add_argument("--rows", help="names of rows, with commas between them")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--stages", action="store_true", help="print each build's stages")
    options = parser.parse_args()
    house = House(options)
    kinds = ("building", "services")
    first = [house.file(kind, storey, 1 + storey) for storey in range(options.storeys) for kind in kinds]
    middle = 2 * (options.storeys // 2)
    other = [house.file(kind, options.storeys // 2, 101) for kind in kinds]

    def with_file(index, file):
        return [*first[:index], file, *first[index + 1 :]]

    revisions = {
        "nothing changed": first,
        "a file renamed": with_file(middle, renamed(first[middle])),
        "two files change places": [*first[:middle], first[middle + 1], first[middle], *first[middle + 2 :]],
        "the last file first": [first[-1], *first[:-1]],
        "one object of the building added": with_file(middle, added_to(first[middle])),
        "one object of the services added": with_file(middle + 1, added_to(first[middle + 1])),
        "a storey's building replaced": with_file(middle, other[0]),
        "a storey's services replaced": with_file(middle + 1, other[1]),
        "a storey's building removed": [*first[:middle], *first[middle + 1 :]],
        "a storey's services removed": [*first[: middle + 1], *first[middle + 2 :]],
        "a building added above": [*first, house.file("building", options.storeys, 102)],
        "services added in the middle": [*first[:middle], house.file("services", options.storeys, 103), *first[middle:]],
    }
    if options.rows:
        revisions = {name: revisions[name] for name in options.rows.split(",")}
    of_file = {"a storey's building replaced": first[middle], "a storey's services replaced": first[middle + 1]}
    whole, report = house.build(first, "whole.tpk")
    print(f"{len(first)} files, {report['source_triangles']} triangles, {report['placed_triangles']} placed")
    print(f"{'':36}{'seconds':>9}{'of a whole build':>18}{'the file':>10}{'made':>9}{'of':>9}")
    rows = []

    def add(name, seconds, report, plain, share=None):
        count = report.get("cache", {"made": 0, "found": 0})
        total = count["made"] + count["found"]
        of_whole, part = f"{100 * seconds / plain:.0f} %", "" if share is None else f"{100 * share:.0f} %"
        print(f"{name:36}{seconds:9.2f}{of_whole:>18}{part:>10}{count['made']:9}{total:9}", flush=True)
        if options.stages:
            print("   ", ", ".join(f"{stage['name']} {stage['seconds']:.2f}" for stage in report["stages"]))
        rows.append({"row": name, "seconds": seconds, "whole": plain, "share": share, "cache": count})

    add("without a cache", whole, report, whole)
    seconds, report = house.build(first, "first.tpk", "cache")
    add("with it, for the first time", seconds, report, whole)
    (house.work / "cache").rename(house.work / "cache.first")
    for name, files in revisions.items():
        shutil.copyfile(house.work / "cache.first", house.work / "cache")
        seconds, report = house.build(files, "again.tpk", "cache")
        plain, _ = house.build(files, "plain.tpk")
        if not filecmp.cmp(house.work / "again.tpk", house.work / "plain.tpk", shallow=False):
            sys.exit(f"{name}: the pack is not that of a whole build")
        share = None
        if name in of_file:
            without, _ = house.build([file for file in first if file != of_file[name]], "plain.tpk")
            share = 1 - without / whole
        add(name, seconds, report, plain, share)
    if options.json:
        options.json.write_text(json.dumps({"rows": rows}))


if __name__ == "__main__":
    main()
