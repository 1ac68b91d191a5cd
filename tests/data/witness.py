#!/usr/bin/env python3
"""Complex and real assemblies of random mechanisms, found without linkwork.

Each family is written as a small polynomial system of its own (circles, spheres, Study quadrics, axis vectors; no joint
transforms), solved by PHCpack's black box (J. Verschelde, PHCpack 2.4.86, Debian package `phcpack`), which finds all
isolated complex solutions. One run of it can lose paths, so runs with other seeds are united, each with the conjugates
of its solutions, until three in a row bring nothing. Every solution is then polished by Newton's method in 40 digits on
the same system, and counted as real if its imaginary parts vanish there. The geometries come from Python's `random`
with a fixed seed; platforms, hands and 6R arms are built backwards from a configuration, so that something is real.

Run:  python3 witness.py witness.json        (needs `phc` and the Python packages mpmath and numpy; some ten minutes;
      names of families may follow, and only those are then written)

A solution is a list of complex numbers [re, im]: cos t + i sin t for an angle t, the length for a slide, and for a pose
its position and the nine entries of its rotation matrix, row by row.
"""

import json
import random
import re
import subprocess
import sys
import tempfile
from math import atan2, cos, hypot, pi, sin, sqrt
from pathlib import Path

import mpmath as mp
import numpy as np

mp.mp.dps = 40


class Poly:
    """A polynomial: coefficients by exponents, which are pairs (variable, power)."""

    def __init__(self, terms=None):
        self.terms = {k: v for k, v in (terms or {}).items() if v != 0}

    @staticmethod
    def of(value):
        return value if isinstance(value, Poly) else Poly({(): value})

    def __add__(self, other):
        terms = dict(self.terms)
        for k, v in Poly.of(other).terms.items():
            terms[k] = terms.get(k, 0) + v
        return Poly(terms)

    def __neg__(self):
        return Poly({k: -v for k, v in self.terms.items()})

    def __sub__(self, other):
        return self + (-Poly.of(other))

    def __rsub__(self, other):
        return Poly.of(other) - self

    def __mul__(self, other):
        terms = {}
        for k, v in self.terms.items():
            for l, w in Poly.of(other).terms.items():
                powers = dict(k)
                for name, power in l:
                    powers[name] = powers.get(name, 0) + power
                key = tuple(sorted(powers.items()))
                terms[key] = terms.get(key, 0) + v * w
        return Poly(terms)

    __radd__ = __add__
    __rmul__ = __mul__

    def derivative(self, name):
        terms = {}
        for k, v in self.terms.items():
            powers = dict(k)
            if name in powers:
                n = powers[name]
                powers[name] = n - 1
                if n == 1:
                    del powers[name]
                key = tuple(sorted(powers.items()))
                terms[key] = terms.get(key, 0) + v * n
        return Poly(terms)

    def at(self, point):
        total = mp.mpc(0)
        for k, v in self.terms.items():
            term = mp.mpc(v)
            for name, power in k:
                term *= point[name] ** power
            total += term
        return total

    def text(self):
        def number(v):
            real = lambda x: f"{float(x):.17E}"
            if isinstance(v, complex):
                return f"({real(v.real)} + ({real(v.imag)})*i)"
            return f"({real(v)})"

        parts = (
            "*".join([number(v)] + [f"{n}^{p}" for n, p in k]) for k, v in self.terms.items()
        )
        return " + ".join(parts)


def variables(*names):
    return [Poly({((n, 1),): 1.0}) for n in names]


def dot(u, v):
    return sum((x * y for x, y in zip(u, v)), Poly())


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def minus(u, v):
    return [x - y for x, y in zip(u, v)]


def plus(*vectors):
    return [sum(parts, Poly()) for parts in zip(*vectors)]


def scaled(k, v):
    return [k * x for x in v]


def rotated(axis, angle, v):
    c, s = cos(angle), sin(angle)
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    out = list(v)
    out[i], out[j] = c * v[i] - s * v[j], s * v[i] + c * v[j]
    return out


def black_box(system, names, seed):
    """Solutions of one run of `phc -b`."""
    with tempfile.TemporaryDirectory() as folder:
        asked, told = Path(folder, "asked"), Path(folder, "told")
        asked.write_text(f"{len(system)}\n" + "".join(p.text() + ";\n" for p in system))
        subprocess.run(["phc", f"-0{seed}", "-b", asked, told], check=True, stdout=subprocess.DEVNULL)
        text = told.read_text() + asked.read_text()
    solutions = []
    for block in re.split(r"the solution for t :", text)[1:]:
        point = {}
        for name, real, imaginary in re.findall(r"^\s*(\w+)\s*:\s*(\S+)\s+(\S+)\s*$", block.split("==")[0], re.M):
            point[name] = mp.mpc(real, imaginary)
        if set(point) == set(names):
            solutions.append(point)
    return solutions


class Newton:
    """Newton's method on a system: in double precision to sort solutions out, in 40 digits to polish them."""

    def __init__(self, system, names):
        self.names, self.system = names, system
        self.slopes = [[p.derivative(n) for n in names] for p in system]

    @staticmethod
    def value(p, x, index):
        total = 0
        for k, v in p.terms.items():
            for name, power in k:
                v = v * x[index[name]] ** power
            total = total + v
        return total

    def both(self, x, number):
        index = {n: i for i, n in enumerate(self.names)}
        x = [number(z) for z in x]
        return [self.value(p, x, index) for p in self.system], [[self.value(d, x, index) for d in row] for row in self.slopes]

    def coarse(self, point):
        """The solution near, if it is regular."""
        x = np.array([complex(point[n]) for n in self.names])
        first = x.copy()
        for _ in range(8):
            values, jacobian = self.both(x, complex)
            try:
                move = np.linalg.solve(np.array(jacobian, complex), np.array(values, complex))
            except np.linalg.LinAlgError:
                return None
            x = x - move
            if abs(move).max() < 1e-12 * (1 + abs(x).max()):
                jacobian = np.array(self.both(x, complex)[1], complex)
                regular = np.linalg.cond(jacobian) < 1e11
                near = abs(x - first).max() < 1e-4 * (1 + abs(x).max())
                return x if regular and near else None
        return None

    def fine(self, x):
        x = mp.matrix([mp.mpc(z) for z in x])
        while True:
            values, jacobian = self.both(x, mp.mpc)
            move = mp.lu_solve(mp.matrix(jacobian), mp.matrix(values))
            x -= move
            if mp.norm(move, mp.inf) < mp.mpf(10) ** -16 * (1 + mp.norm(x, mp.inf)):
                # the next step would be as much smaller again
                return dict(zip(self.names, x))


def solve(system, names, keep=lambda point: True, mirror=lambda x: x.conj()):
    """All isolated regular solutions: runs united until three in a row bring nothing.

    Geometries are real, so the conjugate of a solution (`mirror`) is one too: a path lost on one side is found again.
    """
    newton = Newton(system, names)
    found, quiet, run = [], 0, 0
    while quiet < 3:
        run += 1
        new = 0
        for point in black_box(system, names, 7919 * run + 1):
            if max(abs(z) for z in point.values()) > 1e7:
                continue
            point = newton.coarse(point)
            for point in [] if point is None else [point, mirror(point)]:
                if all(abs(point - other).max() > 1e-7 for other in found):
                    found.append(point)
                    new += 1
        quiet = 0 if new else quiet + 1
    points = [newton.fine(x) for x in found]
    return [p for p in points if keep(p)]


# ---------------------------------------------------------------- families: numbers, polynomials, values


def circle(c, s):
    return c * c + s * s - 1.0


def turn(p, k):
    return p[f"c{k}"] + 1j * p[f"s{k}"]


def unit(angle):
    return mp.mpc(cos(angle), sin(angle))


def four_bar(g):
    c, s = variables("c1", "s1")
    pin = (g["l1"] * cos(g["theta1"]), g["l1"] * sin(g["theta1"]))
    x, y = g["l0"] + g["l3"] * c - pin[0], g["l3"] * s - pin[1]
    values = lambda p: [
        turn(p, 1),
        (x.at(p) + 1j * y.at(p)) / g["l2"] / unit(g["theta1"]),
    ]
    return [circle(c, s), x * x + y * y - g["l2"] ** 2], values


def slider_crank(g):
    (s,) = variables("s")
    x, y = s - g["r"] * cos(g["theta"]), g["e"] - g["r"] * sin(g["theta"])
    values = lambda p: [p["s"], (x.at(p) + 1j * y) / g["l"] / unit(g["theta"])]
    return [x * x + y * y - g["l"] ** 2], values


def five_bar(g):
    x, y = variables("x", "y")
    elbows = [
        (g["r1"] * cos(g["theta1"]), g["r1"] * sin(g["theta1"])),
        (g["g"] + g["r2"] * cos(g["theta2"]), g["r2"] * sin(g["theta2"])),
    ]
    arms = [(x - ex, y - ey) for ex, ey in elbows]
    system = [a * a + b * b - g[f"k{i}"] ** 2 for i, (a, b) in enumerate(arms, 1)]
    values = lambda p: [
        (a.at(p) + 1j * b.at(p)) / g[f"k{i}"] / unit(g[f"theta{i}"]) for i, (a, b) in enumerate(arms, 1)
    ]
    return system, values


def planar_3rpr(g):
    x, y, c, s = variables("x", "y", "c1", "s1")
    system = [circle(c, s)]
    for i in (1, 2, 3):
        u, v = g[f"b{i}x"], g[f"b{i}y"]
        dx, dy = x + c * u - s * v - g[f"a{i}x"], y + s * u + c * v - g[f"a{i}y"]
        system.append(dx * dx + dy * dy - g[f"rho{i}"] ** 2)
    return system, lambda p: [p["x"], p["y"], turn(p, 1)]


def triangle(points, sides):
    """Three points on circles keep their distances."""
    pairs = [(0, 1), (1, 2), (2, 0)]
    system = [circle(*variables(f"c{i}", f"s{i}")) for i in (1, 2, 3)]
    for (i, j), side in zip(pairs, sides):
        apart = minus(points[i], points[j])
        system.append(dot(apart, apart) - side**2)
    return system, lambda p: [turn(p, 1), turn(p, 2), turn(p, 3)]


def three_rps(g):
    points = []
    for i in (1, 2, 3):
        c, s = variables(f"c{i}", f"s{i}")
        # phi is measured from the upright leg inwards about the tangent; the leg stands in a vertical plane
        radial, height = g[f"r{i}"] - g[f"l{i}"] * s, g[f"l{i}"] * c
        points.append([radial * cos(g[f"g{i}"]), radial * sin(g[f"g{i}"]), height])
    corner = lambda i: (g[f"b{i}x"], g[f"b{i}y"])
    sides = [sqrt(sum((a - b) ** 2 for a, b in zip(corner(i), corner(j)))) for i, j in ((1, 2), (2, 3), (3, 1))]
    return triangle(points, sides)


def hand(g):
    points = []
    for i in (1, 2, 3):
        c, s = variables(f"c{i}", f"s{i}")
        theta, psi = g[f"theta{i}"], g[f"psi{i}"]
        # the last link lies in the finger's plane at psi + phi
        reach = g[f"m{i}"] + g[f"n{i}"] * cos(psi) + g[f"o{i}"] * (cos(psi) * c - sin(psi) * s)
        height = g[f"n{i}"] * sin(psi) + g[f"o{i}"] * (sin(psi) * c + cos(psi) * s)
        tip = rotated("y", g[f"gamma{i}"], [cos(theta) * reach, sin(theta) * reach, height])
        points.append(plus(tip, [g[f"f{i}{k}"] for k in "xyz"]))
    return triangle(points, [g["k12"], g["k23"], g["k31"]])


def spherical_four_bar(g):
    c, s = variables("c1", "s1")
    # the driven pin about the driven shaft, which is turned from the driving one by the ground arc
    pin = rotated("x", g["ground"], [sin(g["driven"]) * s, -sin(g["driven"]) * c, Poly.of(cos(g["driven"]))])
    crank = [sin(g["crank"]) * sin(g["theta1"]), -sin(g["crank"]) * cos(g["theta1"]), cos(g["crank"])]
    return [circle(c, s), dot(pin, crank) - cos(g["coupler"])], lambda p: [turn(p, 1)]


def rssr(g):
    c, s = variables("c1", "s1")
    a = [g["a"] * cos(g["theta"]), g["a"] * sin(g["theta"]), g["k"]]
    b = rotated("z", g["yaw"], rotated("x", g["tilt"], [g["c"] * c, g["c"] * s, Poly.of(g["d"])]))
    apart = minus(plus(b, [g["x"], g["y"], g["z"]]), a)
    return [circle(c, s), dot(apart, apart) - g["s"] ** 2], lambda p: [turn(p, 1)]


def watt(g):
    c1, s1, c2, s2 = variables("c1", "s1", "c2", "s2")
    x, y = g["g1"] + g["c1"] * c1 - g["a1"] * cos(g["theta"]), g["c1"] * s1 - g["a1"] * sin(g["theta"])
    u, v = cos(g["phase"]), sin(g["phase"])
    z, w = g["g2"] + g["c2"] * c2 - g["a2"] * (u * c1 - v * s1), g["c2"] * s2 - g["a2"] * (v * c1 + u * s1)
    system = [circle(c1, s1), circle(c2, s2), x * x + y * y - g["b1"] ** 2, z * z + w * w - g["b2"] ** 2]
    return system, lambda p: [turn(p, 1), turn(p, 2)]


def stephenson(g):
    c1, s1, c2, s2 = variables("c1", "s1", "c2", "s2")  # crank and coupler, both from the base line
    x, y = g["a"] * c1 + g["b"] * c2 - g["g"], g["a"] * s1 + g["b"] * s2
    px, py = g["qx"] + g["r"] * cos(g["theta"]), g["qy"] + g["r"] * sin(g["theta"])
    z = g["a"] * c1 + g["u"] * c2 - g["v"] * s2 - px
    w = g["a"] * s1 + g["u"] * s2 + g["v"] * c2 - py
    system = [circle(c1, s1), circle(c2, s2), x * x + y * y - g["c"] ** 2, z * z + w * w - g["l"] ** 2]
    values = lambda p: [turn(p, 1), turn(p, 2) / turn(p, 1), (x.at(p) + 1j * y.at(p)) / g["c"]]
    return system, values


def six_r(g):
    """Unit vectors along the axes: neighbours keep their twist, and the links make a closed polygon.

    After L.-W. Tsai and A. P. Morgan 1985, in axis vectors.
    """
    base = [rotated("z", g["yaw"], rotated("y", g["pitch"], rotated("x", g["roll"], axis))) for axis in
            ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0])]
    sixth = [0.0, sin(g["alpha6"]), cos(g["alpha6"])]  # the loop ends in the frame of the ground
    axes = [base[2]] + [variables(f"x{i}", f"y{i}", f"z{i}") for i in (2, 3, 4, 5)] + [sixth]
    links = [scaled(1 / sin(g[f"alpha{i}"]), cross(axes[i - 1], axes[i])) for i in range(1, 6)] + [[1.0, 0.0, 0.0]]
    system = [dot(z, z) - 1.0 for z in axes[1:5]]
    system += [dot(axes[i - 1], axes[i]) - cos(g[f"alpha{i}"]) for i in range(1, 6)]
    polygon = [g["px"], g["py"], g["pz"]]
    for i in range(6):
        polygon = plus(polygon, scaled(g[f"d{i + 1}"], axes[i]), scaled(g[f"a{i + 1}"], links[i]))
    system += polygon

    def values(p):
        number = lambda v: [Poly.of(x).at(p) for x in v]
        inner = lambda u, v: sum(x * y for x, y in zip(u, v))
        z, x = [number(v) for v in axes], [number(v) for v in [base[0]] + links]
        return [inner(x[i], x[i + 1]) + 1j * inner(z[i], cross(x[i], x[i + 1])) for i in range(6)]

    return system, values


def product(p, q):
    (a, u), (b, v) = (p[0], p[1:]), (q[0], q[1:])
    return [a * b - dot(u, v)] + plus(scaled(a, v), scaled(b, u), cross(u, v))


def platform(g):
    """Study quadrics (M. L. Husty 1996): e is the rotation, g the translation times e, e·g = 0."""
    e, d = variables("u0", "u1", "u2", "u3"), variables("v0", "v1", "v2", "v3")  # to PHCpack e is 1
    conjugate = lambda q: [q[0]] + [-x for x in q[1:]]
    turned = lambda b: product(product(e, [Poly()] + [Poly.of(x) for x in b]), conjugate(e))[1:]
    norm = dot(e, e)
    before, after = product(conjugate(e), d)[1:], product(d, conjugate(e))[1:]
    legs = []
    for i in range(1, 7):
        a, b = ([g[f"{n}{i}{k}"] for k in "xyz"] for n in "ab")
        constant = sum(x * x for x in a) + sum(x * x for x in b) - g[f"l{i}"] ** 2
        legs.append(4.0 * dot(d, d) + constant * norm + 4.0 * dot(b, before) - 4.0 * dot(a, after)
                    - 2.0 * dot(a, turned(b)))
    # all legs less the first are free of g·g
    system = [legs[0]] + [leg - legs[0] for leg in legs[1:]] + [dot(e, d)]
    chance = random.Random(11)
    patch = [complex(chance.gauss(0, 1), chance.gauss(0, 1)) for _ in e]
    system.append(dot(patch, e) - 1.0)
    entries = [turned(axis) for axis in ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0])]

    def values(p):
        n = norm.at(p)
        position = [2 * x.at(p) / n for x in after]
        return position + [entries[column][row].at(p) / n for row in range(3) for column in range(3)]

    def mirror(x):
        # the conjugate, scaled back to the patch
        return x.conj() / np.dot(patch, x.conj()[:4])

    return system, values, lambda p: abs(norm.at(p)) > 1e-10, mirror


def six_three(g):
    """Each corner of the platform turns about the line of its two feet; three corners keep their distances."""
    points = []
    for i in (1, 2, 3):
        c, s = variables(f"c{i}", f"s{i}")
        a, b = ([g[f"a{2 * i - n}{k}"] for k in "xyz"] for n in (1, 0))
        along = [y - x for x, y in zip(a, b)]
        length = sqrt(sum(x * x for x in along))
        along = [x / length for x in along]
        p, q = g[f"l{2 * i - 1}"], g[f"l{2 * i}"]
        foot = (p * p - q * q + length * length) / (2 * length)
        radius = sqrt(p * p - foot * foot)
        other = [0.0, 0.0, 1.0] if abs(along[2]) < 0.9 else [1.0, 0.0, 0.0]
        side = [x - sum(o * u for o, u in zip(other, along)) * y for x, y in zip(other, along)]
        size = sqrt(sum(x * x for x in side))
        side = [x / size for x in side]
        third = [along[1] * side[2] - along[2] * side[1], along[2] * side[0] - along[0] * side[2],
                 along[0] * side[1] - along[1] * side[0]]
        points.append(plus([x + foot * y for x, y in zip(a, along)], scaled(radius * c, side), scaled(radius * s, third)))
    corners = [[g[f"b{i}{k}"] for k in "xyz"] for i in (1, 2, 3)]
    sides = [sqrt(sum((x - y) ** 2 for x, y in zip(corners[i], corners[j]))) for i, j in ((0, 1), (1, 2), (2, 0))]
    system, _ = triangle(points, sides)

    def frame(p, q, r):
        inner = lambda u, v: sum(x * y for x, y in zip(u, v))
        x = [b - a for a, b in zip(p, q)]
        n = mp.sqrt(inner(x, x))
        x = [a / n for a in x]
        y = [b - a for a, b in zip(p, r)]
        k = inner(x, y)
        y = [a - k * b for a, b in zip(y, x)]
        n = mp.sqrt(inner(y, y))
        y = [a / n for a in y]
        return [x, y, cross(x, y)]

    def values(p):
        moved = [[x.at(p) for x in point] for point in points]
        # the square roots are the same real ones for platform and corners: sides agree
        new, old = frame(*moved), frame(*[[mp.mpf(x) for x in c] for c in corners])
        rotation = [[sum(new[k][i] * old[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
        position = [moved[0][i] - sum(rotation[i][j] * corners[0][j] for j in range(3)) for i in range(3)]
        return position + [x for row in rotation for x in row]

    return system, values


def delta(g):
    """A hand that only translates: three spheres about the elbows, moved by the hand's corners."""
    p = variables("x", "y", "z")
    system = []
    for i in (1, 2, 3):
        reach = g[f"w{i}"] + g[f"L{i}"] * cos(g[f"theta{i}"]) - g[f"u{i}"]
        elbow = [reach * cos(g[f"g{i}"]), reach * sin(g[f"g{i}"]), -g[f"L{i}"] * sin(g[f"theta{i}"])]
        apart = minus(p, elbow)
        system.append(dot(apart, apart) - g[f"k{i}"] ** 2)
    return system, lambda p: [p["x"], p["y"], p["z"]]


def delta_of_rods(g):
    """The same with six free rods: a Stewart–Gough platform with feet at the elbows."""
    points = {}
    for i in (1, 2, 3):
        for n, side in ((2 * i - 1, 1.0), (2 * i, -1.0)):
            reach = g[f"w{i}"] + g[f"L{i}"] * cos(g[f"theta{i}"])
            c, s, w = cos(g[f"g{i}"]), sin(g[f"g{i}"]), side * g["h"]
            foot = [reach * c - w * s, reach * s + w * c, -g[f"L{i}"] * sin(g[f"theta{i}"])]
            corner = [g[f"u{i}"] * c - w * s, g[f"u{i}"] * s + w * c, 0.0]
            for k, x, y in zip("xyz", foot, corner):
                points[f"a{n}{k}"], points[f"b{n}{k}"] = x, y
            points[f"l{n}"] = g[f"k{i}"]
    return platform(points)


# ---------------------------------------------------------------- random numbers


def rounded(g):
    """Six digits: short to read, and the same numbers in every program."""
    return {k: round(v, 6) for k, v in g.items()}


def geometries(r):
    u = r.uniform
    angle = lambda: u(-pi, pi)
    for k in range(4):
        yield "four_bar", four_bar, {"l0": u(3, 5), "l1": u(1, 2), "l2": u(3, 5), "l3": u(2, 4), "theta1": angle()}
    yield "four_bar", four_bar, {"l0": u(3, 5), "l1": u(1, 2), "l2": u(8, 9), "l3": u(2, 2.5), "theta1": u(-1, 1)}
    for k in range(3):
        yield "slider_crank", slider_crank, {"r": u(0.5, 1.5), "l": u(2, 4), "e": u(-1, 1), "theta": angle()}
    for k in range(3):
        yield "five_bar", five_bar, {"g": u(0.1, 0.5), "r1": u(0.2, 0.4), "r2": u(0.2, 0.4), "k1": u(0.35, 0.6),
                                     "k2": u(0.35, 0.6), "theta1": angle(), "theta2": angle()}
    for k in range(4):
        g = {}
        pose = (u(-1, 1), u(-1, 1), angle())
        for i in (1, 2, 3):
            a, b = (u(-3, 3), u(-3, 3)), (u(-2, 2), u(-2, 2))
            c, s = cos(pose[2]), sin(pose[2])
            end = (pose[0] + c * b[0] - s * b[1], pose[1] + s * b[0] + c * b[1])
            g |= {f"a{i}x": a[0], f"a{i}y": a[1], f"b{i}x": b[0], f"b{i}y": b[1],
                  f"rho{i}": sqrt((end[0] - a[0]) ** 2 + (end[1] - a[1]) ** 2)}
        yield "planar_3rpr", planar_3rpr, g
    for k in range(3):
        g = {}
        for i in (1, 2, 3):
            about = 2 * pi * (i - 1) / 3
            g |= {f"g{i}": about + u(-0.4, 0.4), f"r{i}": u(0.8, 1.2), f"l{i}": u(0.5, 0.9)}
            size = u(0.4, 0.7)
            tilt = about + u(-0.3, 0.3)
            g |= {f"b{i}x": size * cos(tilt), f"b{i}y": size * sin(tilt)}
        yield "three_rps", three_rps, g
    for k in range(3):
        g = {}
        for i, place, about in ((1, (0, -0.5, 0.9), 0.0), (2, (0, 0.5, 0.9), 0.0), (3, (0, 0, 0), pi / 4)):
            g |= {f"theta{i}": u(-0.4, 0.4), f"psi{i}": u(-0.7, 0.3), f"gamma{i}": about + u(-0.2, 0.2),
                  f"m{i}": u(0.8, 1.2), f"n{i}": u(0.4, 0.6), f"o{i}": u(0.25, 0.45)}
            g |= {f"f{i}{c}": x + u(-0.1, 0.1) for c, x in zip("xyz", place)}
        # distances of a grasp: fingertips at random angles
        tips = []
        for i in (1, 2, 3):
            phi, theta, psi = angle(), g[f"theta{i}"], g[f"psi{i}"]
            reach = g[f"m{i}"] + g[f"n{i}"] * cos(psi) + g[f"o{i}"] * cos(psi + phi)
            height = g[f"n{i}"] * sin(psi) + g[f"o{i}"] * sin(psi + phi)
            tip = rotated("y", g[f"gamma{i}"], [cos(theta) * reach, sin(theta) * reach, height])
            tips.append([x + g[f"f{i}{c}"] for x, c in zip(tip, "xyz")])
        for i, j in ((1, 2), (2, 3), (3, 1)):
            g[f"k{i}{j}"] = sqrt(sum((x - y) ** 2 for x, y in zip(tips[i - 1], tips[j - 1])))
        yield "hand", hand, g
    for k in range(3):
        yield "spherical_four_bar", spherical_four_bar, {
            "crank": u(0.3, 0.8), "coupler": u(0.9, 1.5), "driven": u(0.8, 1.4), "ground": u(0.9, 1.5), "theta1": angle()}
    for k in range(3):
        yield "rssr", rssr, {"a": u(0.2, 0.3), "c": u(0.4, 0.6), "d": u(-0.1, 0.1), "k": u(-0.1, 0.1),
                             "x": u(0.4, 0.7), "y": u(0.2, 0.5), "z": u(-0.2, 0.2), "yaw": angle(), "tilt": u(0.5, 2.5),
                             "s": u(0.7, 0.9), "theta": angle()}
    for k in range(3):
        yield "watt", watt, {"g1": u(4, 6), "a1": u(1, 2), "b1": u(4, 5), "c1": u(3, 4), "g2": u(5, 7), "a2": u(2, 3),
                             "b2": u(5, 6), "c2": u(3, 4.5), "phase": angle(), "theta": angle()}
    for k in range(3):
        yield "stephenson", stephenson, {"g": u(5, 6.5), "a": u(1.5, 2.5), "b": u(4.5, 5.5), "c": u(3.5, 4.5),
                                         "u": u(1.5, 3), "v": u(-2, 2), "l": u(1.5, 2.5), "r": u(0.7, 1.3),
                                         "qx": u(2, 3), "qy": u(-2, 0), "theta": angle()}
    for k in range(3):
        g, q = {}, [angle() for _ in range(6)]
        columns = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0])
        for i in range(1, 7):
            g |= rounded({f"a{i}": u(0.1, 1), f"alpha{i}": u(0.5, 2.6), f"d{i}": u(-0.7, 0.7)})
        # the arm from its hand back to its foot: base times arm is the identity
        moves = []
        for i in range(1, 7):
            angle_i, alpha, a, d = q[i - 1], g[f"alpha{i}"], g[f"a{i}"], g[f"d{i}"]
            # A^-1 = Rx(-alpha) T(-a, 0, -d) Rz(-theta)
            moves.append(lambda v, free, t=angle_i, al=alpha, a=a, d=d: rotated(
                "x", -al, [x - (y if free else 0.0) for x, y in zip(rotated("z", -t, v), (a, 0.0, d))]))
        def through(v, free):
            for move in moves:
                v = move(v, free)
            return v
        place = through([0.0, 0.0, 0.0], True)
        x, y, z = (through(list(c), False) for c in columns)
        g |= {"px": place[0], "py": place[1], "pz": place[2], "yaw": atan2(x[1], x[0]),
              "pitch": atan2(-x[2], hypot(x[0], x[1])), "roll": atan2(y[2], z[2])}
        yield "six_r", six_r, g
    for family, scheme in (("six_three", six_three), ("stewart_gough", platform)):
        for k in range(3 if family == "six_three" else 2):
            g = {}
            home = [u(-0.2, 0.2), u(-0.2, 0.2), u(0.7, 1.0)]
            tilt = [u(-0.5, 0.5) for _ in range(3)]
            for i in range(1, 7):
                about = pi / 3 * i + u(-0.3, 0.3)
                size, small = u(0.8, 1.2), u(0.4, 0.7)
                g |= {f"a{i}x": size * cos(about), f"a{i}y": size * sin(about), f"a{i}z": u(-0.2, 0.2)}
                if family == "stewart_gough" or i <= 3:
                    about = pi / 3 * i if family == "stewart_gough" else 2 * pi / 3 * (i - 0.25)
                    g |= {f"b{i}x": small * cos(about), f"b{i}y": small * sin(about), f"b{i}z": u(-0.2, 0.2)}
            g = rounded(g)
            for i in range(1, 7):
                j = i if family == "stewart_gough" else (i + 1) // 2
                b = [g[f"b{j}{c}"] for c in "xyz"]
                end = rotated("z", tilt[2], rotated("y", tilt[1], rotated("x", tilt[0], b)))
                g[f"l{i}"] = sqrt(sum((x + h - g[f"a{i}{c}"]) ** 2 for x, h, c in zip(end, home, "xyz")))
            yield family, scheme, g
    for k in range(3):
        g = {}
        for i in (1, 2, 3):
            g |= {f"g{i}": 2 * pi * (i - 1) / 3 + u(-0.3, 0.3), f"w{i}": u(0.15, 0.25), f"u{i}": u(0.04, 0.1),
                  f"L{i}": u(0.45, 0.55), f"k{i}": u(1.1, 1.3), f"theta{i}": u(-0.3, 0.7)}
        yield "delta", delta, g | {"h": 0.05}
        if k == 0:
            yield "delta_of_rods", delta_of_rods, g | {"h": 0.05}


def main():
    wanted = sys.argv[2:]
    out = []
    for family, scheme, g in geometries(random.Random(20260101)):
        if wanted and family not in wanted:
            continue
        g = rounded(g)
        system, values, *keep = scheme(g)
        names = sorted({n for p in system for k in p.terms for n, _ in k})
        found = solve(system, names, *keep)
        solutions = []
        for point in found:
            v = [mp.mpc(x) for x in values(point)]
            # a platform's unknowns are complex by the patch, its pose is not
            real = max(abs(mp.im(z)) for z in (v if family in POSES else point.values())) < 1e-20
            solutions.append({"real": bool(real), "values": [[float(mp.re(z)), float(mp.im(z))] for z in v]})
        solutions.sort(key=lambda s: (not s["real"], s["values"]))
        out.append({"family": family, "numbers": g, "complex": len(found),
                    "real": sum(s["real"] for s in solutions), "solutions": solutions})
        print(family, len(found), out[-1]["real"], flush=True)
    head = {
        "how": "tests/data/witness.py: PHCpack 2.4.86 (phc -b, runs with other seeds united until three in a row "
               "bring nothing) on polynomial systems of its own, polished to 30 digits; no part of linkwork is used",
        "values": "cos t + i sin t for an angle, the length for a slide, position and rotation matrix row by row for a pose, "
                  "each as [re, im]",
    }
    body = ",\n".join(json.dumps(case) for case in out)
    Path(sys.argv[1]).write_text(json.dumps(head)[:-1] + ', "cases": [\n' + body + "\n]}\n")


POSES = {"stewart_gough", "six_three", "delta_of_rods"}

if __name__ == "__main__":
    main()
