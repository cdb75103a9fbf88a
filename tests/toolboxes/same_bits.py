#!/usr/bin/env python3
"""A pursuit with the camera gives the same bytes of trace on a processor without FMA and AVX as on this one.

    VAGUS_BIN=… same_bits.py EXAMPLES
"""
import json
import os
import subprocess
import sys
import tempfile

PLAN = {
    "format": "vagus-plan/1",
    "name": "Pursuit",
    "toolboxes": ["carbot"],
    "configuration": {"angle": {"type": "float"}, "distance": {"type": "float"}},
    "start": {"actor": "find"},
    "actors": {
        "find": {
            "template": "FindObject",
            "out": {"angle": "angle", "distance": "distance"},
            "states": {"ObjectFound": "follow", "NoObjectFound": "@terminate"},
        },
        "follow": {
            "template": "FollowObject",
            "out": {"angle": "angle", "distance": "distance"},
            "states": {"ObjectReached": "@terminate", "ObjectLost": "@terminate"},
        },
    },
}
WORLD = {
    "format": "vagus-world/1",
    "size": [6, 5],
    "objects": [
        {"kind": "cylinder", "at": [1.2, 3.7], "radius": 0.12, "height": 0.3, "colour": [0.9, 0.1, 0.1]},
        {"kind": "box", "at": [2, 1], "angle": 0.4, "size": [0.5, 0.3], "height": 0.3, "colour": [0.1, 0.4, 0.9]},
    ],
    "robots": [{"name": "carbot", "type": "carbot", "at": [4, 2], "script": "SCRIPT"}],
}
# What the C library and OpenCV choose their code by.
OLDER = {
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2",
    "OPENCV_CPU_DISABLE": "SSE4_1,SSE4_2,AVX,FP16,AVX2,FMA3,AVX512_SKX",
}


def run(folder, environment):
    command = [os.environ["VAGUS_BIN"], "plan", "run", f"{folder}/p.plan.json", "--world", f"{folder}/w.world.json",
               "--clock", "virtual", "--seed", "5", "--trace", "-", "--trace-all", f"{folder}/all.jsonl"]
    done = subprocess.run(command, env={**os.environ, **environment}, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"same_bits.py: vagus plan run ended with {done.returncode}: {done.stderr}{done.stdout}")
    with open(f"{folder}/all.jsonl", encoding="utf-8") as trace:
        return done.stdout + trace.read()


def main():
    with tempfile.TemporaryDirectory() as folder:
        world = json.loads(json.dumps(WORLD).replace("SCRIPT", f"{sys.argv[1]}/carbot/carbot.aesl"))
        for name, content in (("p.plan.json", PLAN), ("w.world.json", world)):
            with open(f"{folder}/{name}", "w", encoding="utf-8") as file:
                json.dump(content, file)
        as_it_is = run(folder, {})
        if "ObjectReached" not in as_it_is:
            sys.exit(f"same_bits.py: the pursuit did not reach its object:\n{as_it_is[-2000:]}")
        if run(folder, OLDER) != as_it_is:
            sys.exit("same_bits.py: the traces differ; something chooses its code by the processor")


main()
