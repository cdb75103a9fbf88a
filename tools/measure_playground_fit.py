#!/usr/bin/env python3
"""Fits the formulas of docs/sensors.md to what measure_playground.py measured.

    tools/measure_playground.py > measured.json
    tools/measure_playground_fit.py measured.json

A Thymio's horizontal sensor is taken as one ray: reading = A c^2 / (c^2 + d^2) up to its range, 0 beyond; d is the
distance from the sensor to the wall along its direction. Fitted are A, c, the places and the directions. Readings of
walls that only a part of the playground's bundle of rays meets jump wildly; a residual counts at most kCap, so that
they do not pull.
"""
import json
import math
import sys

CAP = 150.0
RANGE = 14.0


def reading(distance, amplitude, width):
    return 0.0 if distance > RANGE else amplitude * width ** 2 / (width ** 2 + max(distance, 0) ** 2)


def rays(parameters):
    """[(x, y, direction)] of the sensors 0 to 6, mirrored about the axis of the robot."""
    front, x0, y0, a0, x1, y1, a1, x5, y5 = parameters[2:]
    return [(x0, y0, a0), (x1, y1, a1), (front, 0, 0), (x1, -y1, -a1), (x0, -y0, -a0), (x5, y5, math.pi), (x5, -y5, math.pi)]


def distance_to_wall(ray, direction, distance):
    """Along the ray to a wall whose normal points to `direction` (robot frame), `distance` from the origin."""
    x, y, angle = ray
    slope = math.cos(angle - direction)
    if slope < 0.2:
        return 99.0
    return (distance - x * math.cos(direction) - y * math.sin(direction)) / slope


def samples(measured):
    for row in measured["front"]:
        yield 0.0, row["distance"], row["prox"]
    for row in measured["back"]:
        yield -math.pi, row["distance"], row["prox"]
    for row in measured["turned"]:
        yield -math.radians(row["angle"]), row["distance"], row["prox"]


def loss(parameters, points):
    amplitude, width = parameters[:2]
    sensors = rays(parameters)
    total = 0.0
    for direction, distance, prox in points:
        for ray, value in zip(sensors, prox):
            if value > 0:
                total += min(abs(reading(distance_to_wall(ray, direction, distance), amplitude, width) - value), CAP)
    return total / len(points)


def simplex(function, start, steps, rounds=4000):
    """Nelder and Mead's downhill simplex."""
    corners = [list(start)] + [[v + (s if i == j else 0) for j, v in enumerate(start)] for i, s in enumerate(steps)]
    corners = sorted((function(corner), corner) for corner in corners)
    size = len(start)
    for _ in range(rounds):
        middle = [sum(corner[1][j] for corner in corners[:-1]) / size for j in range(size)]

        def along(factor):
            point = [m + factor * (w - m) for m, w in zip(middle, corners[-1][1])]
            return function(point), point

        best = along(-1)
        if best[0] < corners[0][0]:
            best = min(best, along(-2))
        elif best[0] >= corners[-2][0]:
            best = min(best, along(0.5))
        if best[0] < corners[-1][0]:
            corners[-1] = best
        else:
            low = corners[0][1]
            corners = [corners[0]] + [(function(p), p) for p in
                                      ([(a + b) / 2 for a, b in zip(low, corner[1])] for corner in corners[1:])]
        corners.sort()
    return corners[0]


def main():
    measured = json.load(open(sys.argv[1]))
    points = list(samples(measured))
    start = [4505, 8.5, 8.0, 6.2, 4.9, math.radians(40), 7.5, 2.6, math.radians(20), -3.0, 3.0]
    steps = [20, 0.2, 0.1, 0.2, 0.2, 0.05, 0.2, 0.2, 0.05, 0.1, 0.2]
    found = start
    for _ in range(3):
        error, found = simplex(lambda p: loss(p, points), found, steps, 700)
    names = ["A", "c", "x2", "x0", "y0", "a0", "x1", "y1", "a1", "x5", "y5"]
    print("mean capped error a wall, all sensors: %.1f" % error)
    for name, value in zip(names, found):
        print("%3s %9.3f%s" % (name, value, "  (%.1f degrees)" % math.degrees(value) if name[0] == "a" else ""))
    print("\ndistance   measured   formula   (front sensor, wall ahead)")
    for row in measured["front"]:
        d = row["distance"] - found[2]
        print("%8.2f %10.0f %9.0f" % (d, row["prox"][2], reading(d, *found[:2])))


if __name__ == "__main__":
    main()
