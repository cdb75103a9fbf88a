#!/usr/bin/env python3
"""The table of docs/events-and-polling.md says what the benchmark measures, and what the page claims.

    table.py bench_events events-and-polling.md
"""
import re
import subprocess
import sys

ROW = re.compile(
    r"^(?P<who>\S.*?) +(?P<load>[\d.]+) % +(?P<frames>\d+)"
    r"(?: +(?P<reaction>\d+) ms +(?P<worst>\d+) ms +(?P<way>[\d.]+) mm)?", re.M)


def rows(text):
    return {
        row["who"]: {key: float(row[key]) for key in ("load", "reaction", "worst") if row[key]}
        for row in ROW.finditer(text)
    }


def check(condition, sentence):
    if not condition:
        sys.exit(f"table.py: {sentence}; run ./dev bench events and bring the page up to date")


def main():
    told = rows(open(sys.argv[2], encoding="utf-8").read())
    found = rows(subprocess.run([sys.argv[1]], check=True, capture_output=True, text=True).stdout)
    check(len(found) == 7, f"the benchmark printed {len(found)} rows, not 7")
    check(told.keys() == found.keys(), f"the page has {sorted(told)}, the benchmark {sorted(found)}")
    for who, row in found.items():
        for key, value in row.items():
            # What others put on the bus may change a little; what the page says must not become wrong.
            room = max(0.1 * value, 0.1 if key == "load" else 2)
            check(abs(told[who][key] - value) <= room, f"{who}: {key} is {value}, the page says {told[who][key]}")
    event, reflex, nobody = found["an event to the plan"], found["the reflex"], found["nobody"]
    check(reflex["worst"] <= event["worst"], "the reflex is slower than the event")
    check(event["load"] < nobody["load"] + 0.05, "watching by events is not for nothing")
    for who, row in found.items():
        if not who.startswith("polling"):
            continue
        check(row["worst"] > event["worst"], f"{who} reacts as fast as the event")
        check(row["load"] > 5 * event["load"], f"{who} costs hardly more than the event")


main()
