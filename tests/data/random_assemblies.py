"""Random mechanisms of eight structures, their files and PHCpack's numbers of solutions.

    python3 random_assemblies.py > random_assemblies.json        (Debian's phcpack: `phc -b`, version 2.4.86)

Planar: links joined by pins, random graphs of five, seven and nine links that are rigid, of seven with one slide, and of six
and eight with one freedom whose first pin on the ground is held. PHCpack is given a number t = exp(i angle) and one u = 1/t for
each link, and for each loop the sums of t (q - p), p and q being the joints at which the loop enters and leaves a link as they
are drawn, and of u times the conjugate. Spatial, of two loops: three points at given distances, on circles, on a line, or moved by
two hinges: cosines and sines. A solution of the polynomials is one of the mechanism and conversely; those that PHCpack calls
singular are none here, and none is met.
"""
import itertools
import json
import math
import random
import re
import subprocess
import sys
import tempfile


def cm(z):
    return f"({z.real:.15g} + {z.imag:.15g}*I)" if z.imag >= 0 else f"({z.real:.15g} - {-z.imag:.15g}*I)"


def phc(equations):
    """Number of finite solutions by polyhedral homotopies."""
    with tempfile.TemporaryDirectory() as folder:
        given, answer = folder + "/in", folder + "/out"
        with open(given, "w") as file:
            file.write(f"{len(equations)}\n" + ";\n".join(equations) + ";\n")
        subprocess.run(["phc", "-b", given, answer], check=True, capture_output=True, timeout=900)
        with open(answer) as file:
            text = file.read()
    tail = text[text.rindex("THE SOLUTIONS"):]
    regular = re.findall(r"== err :\s*(\S+) = rco :\s*(\S+) = res :\s*(\S+) =", tail)
    return sum(float(rco) > 1e-10 and float(res) < 1e-8 for _, rco, res in regular)


def loops(links, joints):
    """Independent loops: lists of (link, joint entered by, joint left by)."""
    tree, cut, reached = {0: None}, [], [0]
    used = set()
    for link in reached:
        for j, (a, b) in enumerate(joints):
            if j not in used and link in (a, b):
                other = b if link == a else a
                if other not in tree:
                    tree[other] = (link, j)
                    reached.append(other)
                    used.add(j)
    for j, (a, b) in enumerate(joints):
        if j not in used:
            cut.append(j)

    def way(link):
        steps = []
        while tree[link] is not None:
            before, j = tree[link]
            steps.append((link, j, before))
            link = before
        return steps

    found = []
    for j in cut:
        a, b = joints[j]
        ways = [way(a), way(b)]
        while ways[0] and ways[1] and ways[0][-1] == ways[1][-1]:
            ways = [w[:-1] for w in ways]
        # from the joint through a back to the common link and out to b
        links_on = [(a, None)] if not ways[0] else []
        sequence = []
        entered = j
        for link, by, before in ways[0]:
            sequence.append((link, entered, by))
            entered = by
        common = ways[0][-1][2] if ways[0] else (ways[1][-1][2] if ways[1] else a)
        out = list(reversed(ways[1]))
        leave = out[0][1] if out else j
        sequence.append((common, entered, leave))
        for k, (link, by, before) in enumerate(out):
            leave = out[k + 1][1] if k + 1 < len(out) else j
            sequence.append((link, by, leave))
        found.append(sequence)
    return found


def rank(rows):
    rows, done = [row[:] for row in rows], 0
    for column in range(len(rows[0])):
        best = max(range(done, len(rows)), key=lambda r: abs(rows[r][column]), default=None)
        if best is None or abs(rows[best][column]) < 1e-9:
            continue
        rows[done], rows[best] = rows[best], rows[done]
        for r in range(done + 1, len(rows)):
            factor = rows[r][column] / rows[done][column]
            rows[r] = [x - factor * y for x, y in zip(rows[r], rows[done])]
        done += 1
        if done == len(rows):
            break
    return done


def is_simple(count, joints):
    """True if no links but all together are rigid."""
    for size in range(3, count):
        for links in itertools.combinations(range(count), size):
            within = sum(a in links and b in links for a, b in joints)
            if 2 * within >= 3 * (size - 1):
                return False
    return True


def graph(rng, count, pins):
    """Pairs of links, each link in two pins at least, whose only motions are those counted; with the first pin on the ground
    held there are none."""
    while True:
        joints = rng.sample(list(itertools.combinations(range(count), 2)), pins)
        degree = [sum(link in pair for pair in joints) for link in range(count)]
        if min(degree) < 2 or max(degree) > 4:
            continue
        at = [complex(rng.uniform(-1, 1), rng.uniform(-1, 1)) for _ in joints]
        around = loops(count, joints)
        if len(around) != pins - count + 1:
            continue
        rows = []
        for loop in around:
            for part in ("real", "imag"):
                row = [0.0] * (count - 1)
                for link, p, q in loop:
                    if link:
                        row[link - 1] += getattr(1j * (at[q] - at[p]), part)
                rows.append(row)
        free = list(range(count - 1))
        if count % 2 == 0:
            held = next((pair for pair in joints if 0 in pair), None)
            if held is None:
                continue
            free.remove(max(held) - 1)
        square = [[row[k] for k in free] for row in rows]
        if len(rows) == len(free) == rank(square) and is_simple(count, joints):
            return joints, around


def planar(rng, count, slide=False):
    mobile = count % 2 == 0
    pins = (3 * (count - 1) - mobile) // 2
    joints, around = graph(rng, count, pins)
    at = [complex(round(rng.uniform(-1, 1), 3), round(rng.uniform(-1, 1), 3)) for _ in joints]
    slides = {rng.randrange(pins): math.radians(rng.randrange(5, 175))} if slide else {}
    driven = next(j for j, pair in enumerate(joints) if 0 in pair) if mobile else None
    if mobile:
        crank = max(joints[driven])
    lines = []
    name = lambda link: '"ground"' if link == 0 else f'"link {link}"'
    for j, (a, b) in enumerate(joints):
        between = f"between: ({name(a)}, {name(b)})"
        if j in slides:
            angle = slides[j]
            direction = f"({math.cos(angle):.6f}, {math.sin(angle):.6f}, 0)"
            lines.append(f'"S{j}": Prismatic(direction: {direction}, {between}, role: Passive),')
        else:
            role = ", role: " + ("Actuated" if j == driven else "Passive")
            lines.append(f'"P{j}": Revolute(point: ({at[j].real}, {at[j].imag}, 0), direction: (0, 0, 1), {between}{role}),')
    text = "Axes(version: 1, name: \"random\", joints: {\n    " + "\n    ".join(lines) + "\n})\n"
    # links that a slide joins turn together
    turn = {link: link for link in range(count)}
    for j in slides:
        a, b = joints[j]
        low, high = min(turn[a], turn[b]), max(turn[a], turn[b])
        turn = {link: low if of == high else of for link, of in turn.items()}
    fixed = {0} | ({turn[crank]} if mobile else set())
    unknown = sorted({of for of in turn.values() if of not in fixed})
    equations = [f"t{k}*u{k} - 1" for k in unknown]
    for loop in around:
        sums = ["", ""]
        for link, p, q in loop:
            k = turn[link]
            # at a slide the sums take the point that is fixed in the link entered; the slide adds its own travel
            ends = [at[p], at[q]]
            step = ends[1] - ends[0]
            for side, letter in enumerate("tu"):
                factor = step if side == 0 else step.conjugate()
                times = "" if k in fixed else f"*{letter}{k}"
                sums[side] += f" + {cm(factor)}{times}"
        for j, angle in slides.items():
            if any(q == j for _, _, q in loop) or any(p == j for _, p, _ in loop):
                index = [q for _, _, q in loop].index(j) if j in [q for _, _, q in loop] else None
                k = turn[joints[j][0]]
                sign = 1 if index is not None and loop[index][0] == joints[j][0] else -1
                for side, letter in enumerate("tu"):
                    along = complex(math.cos(angle), math.sin(angle) * (1 if side == 0 else -1))
                    times = "" if k in fixed else f"*{letter}{k}"
                    sums[side] += f" + {cm(sign * along)}{times}*s"
        equations += [sum.lstrip(" +") for sum in sums]
    return text, equations


def spatial(rng, kinds):
    """Three points of a body on legs of these kinds: "F" fixed, "R" on a hinge, "RR" on two, "P" on a slide."""
    number = lambda: round(rng.uniform(-1, 1), 2)
    joints, chains, points, equations, variables = [], [], [], [], 0
    homes = []
    for leg, kind in enumerate(kinds):
        base = [number() + 2 * math.cos(2.1 * leg), number() + 2 * math.sin(2.1 * leg), number()]
        base = [round(x, 2) for x in base]
        turn = [rng.randrange(-90, 90), rng.randrange(-90, 90)]
        rows, tip = [], ""
        rot = mat(rz(turn[0]), rx(turn[1]))
        where = [f"({x})" for x in base]
        home = list(base)
        axes = rot
        if kind == "P":
            joints.append(f'"q{leg}": Passive(home: {number()}),')
            rows = [f'(d: "q{leg}")']
            where = [f"{where[i]} + ({axes[i][2]:.15g})*x{variables}" for i in range(3)]
            variables += 1
        elif kind in ("R", "RR"):
            lengths = [round(rng.uniform(0.6, 1.5), 2) for _ in kind]
            twist = rng.randrange(30, 80)
            offset = number()
            joints += [f'"q{leg}{k}": Passive(home: {number()}),' for k in range(len(kind))]
            rows = [f'(theta: "q{leg}0")']
            if kind == "RR":
                rows.append(f'(alpha: "{twist} deg", a: {lengths[0]}, d: {offset}, theta: "q{leg}1")')
            tip = f", tip: [Tx({lengths[-1]})]"
            cs = [(f"c{leg}{k}", f"s{leg}{k}") for k in range(len(kind))]
            equations += [f"{c}^2 + {s}^2 - 1" for c, s in cs]
            if kind == "R":
                local = [f"{lengths[0]}*{cs[0][0]}", f"{lengths[0]}*{cs[0][1]}", "0"]
            else:
                ca, sa = math.cos(math.radians(twist)), math.sin(math.radians(twist))
                c, s = cs[1]
                inner = [f"({lengths[0]} + {lengths[1]}*{c})", f"({ca * lengths[1]:.15g}*{s} - ({sa * offset:.15g}))",
                         f"({sa * lengths[1]:.15g}*{s} + ({ca * offset:.15g}))"]
                c, s = cs[0]
                local = [f"({c}*{inner[0]} - {s}*{inner[1]})", f"({s}*{inner[0]} + {c}*{inner[1]})", inner[2]]
            where = [f"{where[i]} + " + " + ".join(f"({axes[i][k]:.15g})*{local[k]}" for k in range(3) if local[k] != "0") for i in range(3)]
        chains.append(f'"leg{leg}": Chain(base: [T({base[0]}, {base[1]}, {base[2]}), Rz("{turn[0]} deg"), Rx("{turn[1]} deg")], rows: [{", ".join(rows)}]{tip}),')
        points.append(where)
    frame = [[round(1.5 * math.cos(2.1 * k) + 0.3 * number(), 2), round(1.5 * math.sin(2.1 * k) + 0.3 * number(), 2), number()] for k in range(3)]
    frames = ", ".join(f'"S{k}": [T({p[0]}, {p[1]}, {p[2]})]' for k, p in enumerate(frame))
    closures = ", ".join(f'"S{k}": Spherical("leg{k}", "top.S{k}")' for k in range(3))
    text = ("Mechanism(version: 1, name: \"random\", convention: Modified,\n    joints: {" + " ".join(joints) + "},\n    chains: {\n        "
            + "\n        ".join(chains) + "\n    },\n    platforms: {\"top\": Platform(frames: {" + frames + "})},\n    closures: {" + closures + "},\n)\n")
    for a, b in itertools.combinations(range(3), 2):
        square = sum((x - y) ** 2 for x, y in zip(frame[a], frame[b]))
        gap = " + ".join(f"({points[a][i]} - ({points[b][i]}))^2" for i in range(3))
        equations.append(f"{gap} - {square:.15g}")
    return text, equations


def rz(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [[c, -s, 0], [s, c, 0], [0, 0, 1]]


def rx(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [[1, 0, 0], [0, c, -s], [0, s, c]]


def mat(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


STRUCTURES = [
    ("planar, five links", 3, lambda rng: planar(rng, 5)),
    ("planar, seven links", 6, lambda rng: planar(rng, 7)),
    ("planar, nine links", 6, lambda rng: planar(rng, 9)),
    ("planar, seven links and a slide", 3, lambda rng: planar(rng, 7, slide=True)),
    ("planar, six links, one held", 3, lambda rng: planar(rng, 6)),
    ("planar, eight links, one held", 3, lambda rng: planar(rng, 8)),
    ("three points on circles", 3, lambda rng: spatial(rng, ["R", "R", "R"])),
    ("points on a line, on circles and on two hinges", 3,
     lambda rng: spatial(rng, rng.choice([["P", "R", "R"], ["P", "P", "R"], ["RR", "R", "F"], ["RR", "P", "F"]]))),
]

if __name__ == "__main__":
    out, number = [], 0
    for structure, count, make in STRUCTURES:
        for k in range(count):
            number += 1
            text, equations = make(random.Random(1000 + number))
            solutions = phc(equations)
            print(number, structure, solutions, file=sys.stderr)
            out.append({"structure": structure, "solutions": solutions, "file": text})
    json.dump(out, sys.stdout, indent=1)
    print()
