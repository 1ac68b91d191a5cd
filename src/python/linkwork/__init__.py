"""Kinematics of parallel robots and closed linkages.

A mechanism is read from a file of Denavit-Hartenberg chains or of joint coordinates, or made of the same parts in
Python. Each question about it is a method, and its answer a :class:`Report`.

>>> import linkwork
>>> from linkwork.parts import Actuated, Chain, Passive, Revolute, Tx
>>> m = linkwork.Mechanism(
...     name="4-bar",
...     joints={"theta1": Actuated(home="60 deg"), "phi2": Passive(), "phi1": Passive()},
...     chains={
...         "left": Chain(rows=[{"theta": "theta1"}, {"a": 2, "theta": "phi2"}], tip=[Tx(4)]),
...         "right": Chain(base=[Tx(4.5)], rows=[{"theta": "phi1"}], tip=[Tx(3.5)]),
...     },
...     closures={"joint": Revolute("left", "right")},
... )
>>> m.assemblies(theta1=1.0).real
2
>>> m.solve(theta1="60 deg").outcome
'converged'

Numbers are in m, rad, N and s; texts are expressions with units as in a file, ``"60 deg"``.
"""

from __future__ import annotations

import difflib
import html
import os
import sys
import warnings
from collections.abc import Mapping, Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _given, _linkwork, executors, parts
from ._given import Value, Wrench, wrenches
from ._linkwork import Error, MechanismError, QuestionError, __version__
from ._progress import Bar, Progress, bar
from ._reports import Fields, Many, Report, Rows
from ._study import Study, study, study_into

__all__ = [
    "Error",
    "Fields",
    "Many",
    "Mechanism",
    "MechanismError",
    "Progress",
    "QuestionError",
    "Report",
    "Rows",
    "Study",
    "__version__",
    "executors",
    "load",
    "parse",
    "parts",
    "study",
    "study_into",
]


def __dir__() -> list[str]:
    return __all__


Values = Mapping[str, Value]
Ranges = Mapping[str, "tuple[Value, Value]"]
Names = Union[str, Sequence[str]]
Array = npt.NDArray[np.float64]


def load(path: str | os.PathLike[str]) -> Mechanism:
    """The mechanism of a file. What is odd about it is a warning of Python."""
    with open(_given.path("path", path), encoding="utf-8") as file:
        return parse(file.read(), os.fspath(path))


def parse(text: str, name: str = "<text>") -> Mechanism:
    """The mechanism that a text describes; errors call it by ``name``."""
    made = Mechanism._of(_given.text("text", text), _given.text("name", name), {})
    if odd := made._core.warnings(name):
        warnings.warn(odd, stacklevel=2)
    return made


#: What every question takes, in the order in which it is put: what is freed is freed first.
_ALWAYS = ("free", "hold", "guess", "mode", "seed")

#: What maps names to something, and what names.
_MAPPINGS = {"hold", "guess", "rate", "acceleration", "load", "dwell", "wrench", "input", "locus", "map"}
_NAMES = {"free", "lock", "output", "point", "trace", "report", "without"}


class Mechanism:
    """A mechanism, which never changes.

    ``Mechanism(joints=..., chains=..., platforms=..., closures=...)`` makes one of the fields of a file, with the
    parts of :mod:`linkwork.parts`; rows are mappings, ``{"alpha": "90 deg", "a": 2, "theta": "phi2"}``.
    :meth:`from_axes` makes one of joint coordinates.

    Every question takes:

    - what is held, by the names of joints, ``theta1=1.0``, or as ``hold={"top.z": 0.5}``, which also names coordinates
      of platforms and of points, ``left+0.5,0.2.x``;
    - what is ``free`` by names; ``"actuated"`` frees all driven joints;
    - values to start at, ``guess={"phi1": "-30 deg"}``;
    - the ``mode``, numbered from 1 as :meth:`assemblies` lists it, or ``"all"``;
    - the ``seed`` of everything random;
    - ``progress``, a function that long work calls with words, what is done and of how much; ``False`` for no bar. Work
      ends at Ctrl-C.

    Keywords are named as the options of the command line.
    """

    _core: _linkwork.Mechanism

    def __init__(self, **fields: Any) -> None:
        whole = {"version": 1, "name": "mechanism", "convention": parts.Modified(), **fields}
        self._become(parts.written(parts.Mechanism(**whole), 3) + "\n", "<Mechanism>", {})

    @classmethod
    def from_axes(cls, **fields: Any) -> Mechanism:
        """A mechanism given by joint coordinates: ``joints={"A": Revolute(point=(0, 0, 0), ...)}``."""
        whole = {"version": 1, "name": "mechanism", **fields}
        return cls._of(parts.written(parts.Axes(**whole), 3) + "\n", "<Axes>", {})

    @classmethod
    def _of(cls, text: str, name: str, values: dict[str, Value]) -> Mechanism:
        made = cls.__new__(cls)
        made._become(text, name, values)
        return made

    def _become(self, text: str, name: str, values: dict[str, Value]) -> None:
        self._made_of = (text, name, values)
        self._core = _linkwork.Mechanism(text, name, values)
        self._joints = frozenset(joint[0] for joint in self._core.joints())

    def __reduce__(self) -> tuple[Any, ...]:
        return Mechanism._of, self._made_of

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Mechanism) and self._made_of == other._made_of

    def __hash__(self) -> int:
        return hash(self._made_of[0])

    def __repr__(self) -> str:
        return repr(self.check())

    def page(self) -> str:
        """The page of ``linkwork view``, one file: the mechanism follows the mouse, with the solver inside."""
        _, name, values = self._made_of
        return self._core.page(os.path.basename(name), values)

    def _repr_html_(self) -> str:
        page = html.escape(self.page(), quote=True)
        frame = (
            f'<iframe srcdoc="{page}" sandbox="allow-scripts" style="width: 100%; height: 36em; border: 0"></iframe>'
        )
        return f"{frame}<noscript>{self._repr_svg_() or ''}</noscript>"

    def _repr_svg_(self) -> str | None:
        try:
            return self.svg()
        except QuestionError:
            return None

    @property
    def name(self) -> str:
        """Its name."""
        return self._core.name

    @property
    def joints(self) -> dict[str, Fields]:
        """The joint variables: ``unit`` (rad or m), whether ``driven``, value at ``home``, ``limits`` or None."""
        keys = ("unit", "driven", "home", "limits")
        return {name: Fields(dict(zip(keys, rest))) for name, *rest in self._core.joints()}

    @property
    def parameters(self) -> dict[str, float]:
        """The parameters with their values, in m, rad or without unit."""
        return dict(self._core.parameters())

    def with_parameters(self, **values: Value) -> Mechanism:
        """The same mechanism with other parameters. Numbers are put in at once; texts are read with the file."""
        text, name, before = self._made_of
        core = self._core.with_parameters(values)
        if core is None:
            return Mechanism._of(text, name, {**before, **values})
        made = Mechanism.__new__(Mechanism)
        made._made_of, made._core, made._joints = (text, name, {**before, **values}), core, self._joints
        return made

    def to_ron(self, axes: bool = False) -> str:
        """The mechanism as a file of tables, or of joint coordinates."""
        return self._core.ron(_given.flag("axes", axes))

    def svg(self, labels: bool = False, **given: Any) -> str:
        """A picture of the assembled mechanism as SVG; with ``mode="all"`` of every assembly."""
        return self._core.svg(self._given("svg", given, {}), _given.flag("labels", labels))

    def _given(self, what: str, given: dict[str, Any], options: dict[str, Any]) -> dict[str, Any]:
        """What is given to a question, in the order in which it is put."""
        put = {key: value for key in _ALWAYS if key in given and (value := given.pop(key)) is not None}
        if given:
            hold = _given.mapping("hold", put.pop("hold", None))
            for name, value in given.items():
                if name not in self._joints:
                    known = [*self._joints, *_ALWAYS, *options]
                    meant = difflib.get_close_matches(name, known, 1)
                    remedy = f"did you mean `{meant[0]}`?" if meant else f"there are {', '.join(sorted(known))}"
                    raise TypeError(f"`{name}` is neither a joint nor an option of {what}(): {remedy}")
                hold[name] = value
            free = put.pop("free", None)
            put = {"hold": hold, **put} if free is None else {"free": free, "hold": hold, **put}
        put.update((key, value) for key, value in options.items() if value is not None)
        for key in put.keys() & _MAPPINGS:
            put[key] = _given.mapping(key, put[key])
        for key in put.keys() & _NAMES:
            put[key] = _given.names(key, put[key])
        return put

    def _ask(self, what: str, given: dict[str, Any], **options: Any) -> Any:
        wanted = given.pop("progress", None)
        method = "singularities" if what in ("along", "loci") else what
        put = self._given(method, given, options)
        if what == "solve" and wanted is None and "mode" not in put:
            return Report(self._core.ask(what, put, None)[0])
        progress = bar(wanted)
        try:
            core, columns = self._core.ask(what, put, progress)
        finally:
            if isinstance(progress, Bar):
                progress.close()
        return Rows(core, columns) if columns else Report(core)

    def check(self) -> Report:
        """What the file says: parameters, tables, closures, loops, Kutzbach's count."""
        return self._ask("check", {})  # type: ignore[no-any-return]

    def solve(self, **given: Any) -> Report:
        """The assembled configuration near home or ``guess``; with ``mode`` that mode followed to what is held.

        The report is false where the mechanism cannot be assembled, and says how near it comes.
        """
        return self._ask("solve", given)  # type: ignore[no-any-return]

    def assemblies(self, *, all_complex: bool | None = None, prove: bool | None = None, **given: Any) -> Report:
        """All assembled configurations with certificates: iterable, ``.real``, ``.complex_count``, ``.complete``.

        ``all_complex=True`` lists those that are not real too; ``prove=True`` proves that no real one is missing, or
        says in ``.proof`` what is left.
        """
        return self._ask("assemblies", given, all_complex=all_complex, prove=prove)  # type: ignore[no-any-return]

    def sweep(
        self,
        name: str | None = None,
        start: Value | None = None,
        stop: Value | None = None,
        *,
        steps: int | None = None,
        input: Ranges | None = None,
        of: Names | None = None,
        report: Names | None = None,
        follow: bool | None = None,
        law: str | None = None,
        duration: Value | None = None,
        straight: bool | None = None,
        certify: bool | None = None,
        dwell: Values | None = None,
        wrench: Mapping[str, Wrench] | None = None,
        load: Values | None = None,
        without: Names | None = None,
        **given: Any,
    ) -> Rows:
        """A motion of an input from ``start`` to ``stop`` in equal ``steps``, with a numpy array for each column.

        ``input={"l1": (0.6, 0.8), ...}`` moves several together; ``of`` traces points, ``"left+0.5,0.2"``; ``report``
        adds quantities, ``"transmission, velocity:left"``; ``follow=True`` goes round dead points, and without input
        along the whole curve. ``law`` and ``duration`` (s, or ``"500 ms"``) say how the input moves in time;
        ``certify=True`` shows by interval arithmetic that all rows lie on one branch.
        """
        ranges = _given.mapping("input", input)
        if name is not None:
            name = _given.text("name", name)
            if start is None or stop is None:
                raise TypeError(f"say where `{name}` starts and stops: sweep(name, start, stop)")
            ranges[name] = (start, stop)
        return self._ask(  # type: ignore[no-any-return]
            "sweep",
            given,
            input=ranges,
            trace=None if of is None else _given.names("of", of),
            report=report,
            follow=follow,
            law=law,
            duration=duration,
            straight=straight,
            certify=certify,
            dwell=dwell,
            wrench=wrenches(wrench),
            load=load,
            without=without,
            steps=steps,
        )

    def circuits(self, *, of: Names | None = None, **given: Any) -> Report:
        """All circuits and branches of a mechanism with one freedom, with the paths of the points ``of``."""
        return self._ask("circuits", given, trace=None if of is None else _given.names("of", of))  # type: ignore[no-any-return]

    def mobility(self, *, lock: Names | None = None, **given: Any) -> Report:
        """The freedoms of the assembled mechanism; what is named by ``lock`` stands still."""
        return self._ask("mobility", given, lock=lock)  # type: ignore[no-any-return]

    def velocity(
        self,
        *,
        rate: Values | None = None,
        acceleration: Values | None = None,
        point: Names | None = None,
        **given: Any,
    ) -> Report:
        """Velocities, Jacobian and condition for ``rate={"l1": 0.1}`` (m/s, rad/s) and ``acceleration``."""
        return self._ask(  # type: ignore[no-any-return]
            "velocity", given, rate=rate, acceleration=acceleration, point=point
        )

    def jacobian(self, **given: Any) -> Array:
        """The input-output Jacobian as an array: rates of the outputs, row by row, for unit rates of what is held.

        ``velocity(...).jacobian`` names its ``rows`` and ``columns`` with their units, in m/s and rad/s.
        """
        report = self.velocity(**given)
        found = report.to_dict().get("jacobian")
        if found is None:
            raise QuestionError(f"there is no Jacobian: {report.to_dict().get('sentence') or report!r}")
        entries = np.array(found["entries"], dtype=np.float64)
        return entries.reshape(len(found["rows"]), len(found["columns"]))

    def statics(
        self,
        *,
        wrench: Mapping[str, Wrench] | None = None,
        load: Values | None = None,
        without: Names | None = None,
        **given: Any,
    ) -> Report:
        """Joint forces that balance ``wrench={"top": (Fx, Fy, Fz, Mx, My, Mz)}`` (N, N·m) and ``load={"phi1": 2}``.

        Weights, springs and forces of the file act too, except those ``without``: ``"weight"``, ``"friction"``, a name.
        """
        return self._ask("statics", given, wrench=wrenches(wrench), load=load, without=without)  # type: ignore[no-any-return]

    def equilibrium(
        self,
        *,
        all: bool | None = None,
        starts: int | None = None,
        lock: Names | None = None,
        wrench: Mapping[str, Wrench] | None = None,
        load: Values | None = None,
        without: Names | None = None,
        **given: Any,
    ) -> Report:
        """Where the mechanism rests under its weights, springs and forces: ``.positions``, with stability and modes.

        It walks downhill in potential energy; ``all=True`` looks for other rest positions from so many ``starts``.
        """
        return self._ask(  # type: ignore[no-any-return]
            "equilibrium",
            given,
            all=all,
            starts=starts,
            lock=lock,
            wrench=wrenches(wrench),
            load=load,
            without=without,
        )

    def simulate(
        self,
        time: Value | None = None,
        *,
        rows: int | None = None,
        rate: Values | None = None,
        lock: Names | None = None,
        of: Names | None = None,
        restitution: float | None = None,
        through: bool | None = None,
        error: float | None = None,
        linearise: bool | None = None,
        wrench: Mapping[str, Wrench] | None = None,
        load: Values | None = None,
        without: Names | None = None,
        **given: Any,
    ) -> Rows:
        """The motion for ``time`` (s, or ``"500 ms"``) of the mechanism let go, with a numpy array for each column.

        It starts with the rates of ``rate`` (m/s, rad/s) at what is held; ``lock`` keeps joints where they are, or
        drives them with their rates, ``"2*pi*time"``; ``of`` gives positions of points. ``restitution`` sends joints
        back from their limits, ``through=True`` goes on where branches of motion meet, and ``error`` is that of one
        step. ``linearise=True`` gives A, B, C and D at the start as ``.linear`` instead.
        """
        return self._ask(  # type: ignore[no-any-return]
            "simulate",
            given,
            time=time,
            rows=rows,
            rate=rate,
            lock=lock,
            trace=None if of is None else _given.names("of", of),
            restitution=restitution,
            through=through,
            error=error,
            linearise=linearise,
            wrench=wrenches(wrench),
            load=load,
            without=without,
        )

    def design(
        self,
        vary: Mapping[str, tuple[Value, Value] | list[Value] | Value],
        positions: Sequence[Mapping[str, Value | Sequence[Value]]] = (),
        *,
        contains: Mapping[str, tuple[Value, Value]] | None = None,
        motion: Mapping[str, tuple[Value, Value]] | None = None,
        at_least: Values | None = None,
        at_most: Values | None = None,
        minimise: Names | None = None,
        maximise: Names | None = None,
        outputs: Names | None = None,
        any_order: bool = False,
        seed: int = 1,
        starts: int = 400,
        approximate: bool = False,
        solutions: int = 100,
        most: int = 10,
        progress: Progress | bool | None = None,
    ) -> Report:
        """Dimensions with which it does what it shall: ``.designs``, best first, each with the text of its ``file``.

        ``vary`` gives ranges ``(least, greatest)``, listed values ``[0.1, 0.12]`` or expressions of others to
        parameters and to further unknowns, and ``positions`` values of quantities or coordinates of points,
        ``{"theta1": 0.5, "coupler": (0.3, 0.2)}``; ``contains`` spans a box of positions. ``motion``, ``at_least``
        and ``at_most`` bound the motion, ``minimise`` and ``maximise`` improve a figure of it such as
        ``"max(force:theta1)"``; of two such goals ``most`` designs are found of which none is beaten in both. Where
        there are as many targets as unknowns all designs are sought, otherwise (or if ``approximate``) from random
        ``starts``.
        """

        def named(of: Mapping[str, Any]) -> str:
            return parts.written({name: tuple(x) if isinstance(x, list) else x for name, x in of.items()})

        fields = {"vary": parts.written(dict(_given.mapping("vary", vary)))}
        fields["positions"] = "[" + ", ".join(named(_given.mapping("positions", of)) for of in positions) + "]"
        ranges = {"contains": contains, "motion": motion, "at_least": at_least, "at_most": at_most}
        fields.update({name: named(_given.mapping(name, of)) for name, of in ranges.items() if of is not None})
        goals = {"minimise": minimise, "maximise": maximise}
        fields.update({n: parts.written(list(_given.names(n, of))) for n, of in goals.items() if of is not None})
        if outputs is not None:
            fields["outputs"] = parts.written(list(_given.names("outputs", outputs)))
        if _given.flag("any_order", any_order):
            fields["order"] = "Any"
        text = ", ".join(f"{name}: {of}" for name, of in fields.items())
        shown = bar(progress)
        try:
            core, columns = _linkwork.design(
                self._core,
                f'Design(version: 1, mechanism: "", {text})',
                _given.count("seed", seed),
                _given.count("starts", starts),
                _given.flag("approximate", approximate),
                _given.count("solutions", solutions),
                _given.count("most", most),
                shown,
            )
        finally:
            if isinstance(shown, Bar):
                shown.close()
        return Rows(core, columns) if columns else Report(core)

    def singularities(
        self,
        *,
        input: Ranges | None = None,
        locus: Ranges | None = None,
        output: Names | None = None,
        point: Names | None = None,
        follow: bool | None = None,
        starts: int | None = None,
        **given: Any,
    ) -> Report:
        """Whether and how the configuration is singular; with ``input`` along it; with ``locus`` of two coordinates the
        curves in their box."""
        what = "loci" if locus else "along" if input else "singularities"
        return self._ask(  # type: ignore[no-any-return]
            what, given, output=output, point=point, input=input, locus=locus, follow=follow, starts=starts
        )

    def workspace(
        self,
        map: Ranges,
        *,
        grid: int | Sequence[int] | None = None,
        search: int | None = None,
        starts: int | None = None,
        **given: Any,
    ) -> Rows:
        """A map of one to three coordinates, ``{"hand.x": (-1, 1), ...}``, with a row for each node of its ``grid``."""
        nodes = None if grid is None else _given.counts("grid", grid)
        return self._ask("workspace", given, map=_given.mapping("map", map), grid=nodes, search=search, starts=starts)  # type: ignore[no-any-return]

    def formulas(self, *, of: str | None = None, relative_to: str | None = None) -> Report:
        """What the mechanism has in closed form, or the transform ``of`` a frame."""
        return self._ask("formulas", {}, of=of, relative_to=relative_to)  # type: ignore[no-any-return]

    def compare(self, *, samples: int | None = None, **given: Any) -> Report:
        """The closed forms of the file against its chains."""
        return self._ask("compare", given, samples=samples)  # type: ignore[no-any-return]

    def solve_many(
        self,
        values: npt.ArrayLike,
        names: Names | None = None,
        *,
        report: Names | None = None,
        jacobian: bool = False,
        search: bool = False,
        wrench: Mapping[str, Wrench] | None = None,
        load: Values | None = None,
        rate: Values | None = None,
        output: Names | None = None,
        **given: Any,
    ) -> Many:
        """A configuration for each row of held values, without reports, on all cores.

        ``values`` has a column for each of ``names``, which are the driven joints unless given, in m and rad. The way
        goes from the configuration of the question straight from row to row, so that neighbouring rows are on one
        branch; limits of joints are not looked at. The answer has an array for each joint and platform coordinate, and
        ``"reached"``; rows that no way leads to are not numbers, and ``reasons`` says why. With ``search=True`` these
        are searched for as :meth:`solve` does, on whatever branch.

        ``report="condition, transmission"`` adds an array of each quantity; ``jacobian=True`` adds ``"jacobian"`` of
        the shape (rows, outputs, inputs), whose ``outputs`` and ``inputs`` are named in the answer.
        """
        if names is None:
            names = [name for name, _, driven, *_ in self._core.joints() if driven]
        names = _given.names("names", names)
        rows = _given.numbers("values", values)
        if rows.ndim == 1 and len(names) == 1:
            rows = rows.reshape(-1, 1)
        if rows.ndim != 2 or rows.shape[1] != len(names):
            raise ValueError(f"give a column for each of {', '.join(names)}; `values` has the shape {rows.shape}")
        jacobian, search = _given.flag("jacobian", jacobian), _given.flag("search", search)
        progress = bar(given.pop("progress", None))
        try:
            options = {"report": report, "wrench": wrenches(wrench), "load": load, "rate": rate, "output": output}
            put = self._given("solve_many", given, options)
            return Many(*self._core.solve_many(put, names, rows, jacobian, search, progress))
        finally:
            if isinstance(progress, Bar):
                progress.close()


def _command() -> None:
    """The command line."""
    sys.exit(_linkwork.run(sys.argv))
