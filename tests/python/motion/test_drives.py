"""Forces, powers and work of the legs along a path: against energies and integrals written in numpy."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import ninedof as nd
from ninedof.motion.tables import drives_table, motion_tables, motion_words
from ninedof.tables.table import plain_text

HOME = nd.Configuration.neutral(3.9828, 2.4432)
MASSES = nd.Masses(
    platform=4.0,
    centre=(0.1, -0.2, 0.3),
    inertia=(1.0, 1.2, 1.5, 0.1, 0.0, 0.2),
    cylinder=0.8,
    rod=0.5,
    cylinder_centre=0.9,
    rod_centre=0.7,
    cylinder_inertia=0.2,
    rod_inertia=0.1,
    internal_point=0.3,
)


@pytest.fixture(scope="module")
def lifted():
    """From rest to rest, sideways and up; O goes a way of its own."""
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    line = nd.Trajectory.line(HOME, (0.5, 0.2, 0.4), duration=2.0, points=2001)
    return nd.follow(g, line, HOME, 0.5, masses=MASSES)


def test_forces_are_those_of_inverse_dynamics(lifted):
    expected = nd.inverse_dynamics(
        lifted.geometry, lifted.configurations, (lifted.velocity, lifted.acceleration), MASSES
    )
    assert_allclose(lifted.leg_forces, expected.forces, rtol=1e-12, atol=1e-12)
    assert_allclose(lifted.leg_powers, expected.power, rtol=1e-12, atol=1e-12)


def test_work_from_rest_to_rest_is_the_change_of_height(lifted):
    """The actuators' net work is mass times 9.81 times the rise of each body: no kinetic energy is left."""
    drives = lifted.drives
    net = drives["work"].sum() - drives["returned"].sum()
    g, ends = lifted.geometry, (lifted.configurations[0], lifted.configurations[-1])

    def potential(c):
        tops = [c.position + c.rotation @ u for u in g.platform_external]
        lows = [c.position + c.rotation @ u for u in g.platform_internal]
        o = c.internal_point
        legs = [*zip(g.base_external, tops, strict=True), *((a, o) for a in (*lows, *g.base_internal))]
        height = 4.0 * (c.position + c.rotation @ MASSES.centre)[2] + 0.3 * o[2]
        for start, end in legs:
            e = (end - start) / np.linalg.norm(end - start)
            height += 0.8 * (start + 0.9 * e)[2] + 0.5 * (end - 0.7 * e)[2]
        return 9.81 * height

    assert net == pytest.approx(potential(ends[1]) - potential(ends[0]), rel=1e-5)


def test_figures_of_drives(lifted):
    drives, f = lifted.drives, lifted.leg_forces
    assert_allclose(drives["push"], np.maximum(f.max(axis=0), 0.0))
    assert_allclose(drives["pull"], np.maximum(-f.min(axis=0), 0.0))
    assert_allclose(drives["rms"], np.sqrt(np.trapezoid(f**2, lifted.time, axis=0) / 2.0), rtol=1e-5)
    power = f * lifted.leg_rates
    assert_allclose(drives["power"], np.maximum(power.max(axis=0), 0.0))
    assert_allclose(drives["work"], np.trapezoid(np.maximum(power, 0.0), lifted.time, axis=0), rtol=1e-4, atol=1e-9)
    assert_allclose(drives["returned"], np.trapezoid(np.maximum(-power, 0), lifted.time, axis=0), rtol=1e-4, atol=1e-9)


def test_newtons_watts_and_joules_in_any_unit():
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)

    def moved(unit, size):
        larger = nd.Geometry(
            *(
                size * getattr(g, name)
                for name in ("base_external", "base_internal", "platform_external", "platform_internal")
            )
        )
        home = nd.Configuration.neutral(size * 3.9828, size * 2.4432)
        line = nd.Trajectory.line(home, (0.5 * size, 0.2 * size, 0.4 * size), points=101, unit=unit)
        masses = nd.Masses(platform=4.0, cylinder=0.8, cylinder_centre=0.9 * size, cylinder_inertia=0.2 * size**2)
        return nd.follow(larger, line, home, 0.5, masses=masses)

    metres, millimetres = moved("m", 1.0), moved("mm", 1000.0)
    assert metres.force_unit == "N"
    for name, values in metres.drives.items():
        assert_allclose(millimetres.drives[name], values, rtol=1e-6, atol=1e-6 * np.abs(values).max())


def test_the_table_names_units_and_legs_that_never_carry(published):
    line = nd.Trajectory.line(HOME, (0.0, 0.0, 0.4), points=51, unit="m")
    lift = nd.follow(published, line, HOME, masses=nd.Masses(platform=2.0))
    assert lift.unloaded_legs == ("l1", "l2", "l3")
    text = plain_text(drives_table(lift.to_dict()))
    assert "power" in text
    assert "(W)" in text
    words = [sentence for _, sentence in motion_words(lift, lift.to_dict())]
    assert any("never carry load: l1, l2, l3" in sentence for sentence in words)
    bare = nd.follow(published, line, HOME)
    assert bare.drives == {}
    assert bare.leg_powers is None
    assert bare.unloaded_legs == ()
    assert drives_table(bare.to_dict()) is None


def test_of_several_loads_forces_are_those_of_each_and_drives_the_largest(lifted, tmp_path):
    """A load of one pose in shape (k, 1, 3), and with a moment for each pose."""
    force = np.array([[0.0, 0.0, -30.0], [40.0, 0.0, 0.0], [0.0, -5.0, 60.0]])[:, None]
    moment = np.linspace(0.0, 3.0, 2001)[:, None] * [0.0, 0.0, 1.0]
    g, how = lifted.geometry, {"internal_point": 0.5, "masses": MASSES}
    every = nd.follow(g, lifted.trajectory, HOME, load=(force, moment), **how)
    each = [nd.follow(g, lifted.trajectory, HOME, load=(one[0], moment), **how) for one in force]
    assert (every.leg_forces.shape, every.load_count, each[0].load_count, lifted.load_count) == ((3, 2001, 9), 3, 1, 1)
    assert_allclose(every.leg_forces, [one.leg_forces for one in each], rtol=1e-12, atol=1e-9)
    assert_allclose(every.leg_powers, [one.leg_powers for one in each], rtol=1e-12, atol=1e-9)
    for name, values in every.drives.items():
        assert_allclose(values, np.max([one.drives[name] for one in each], axis=0), rtol=1e-12, atol=1e-9)
    assert every.unloaded_legs == ()
    nd.save(every, tmp_path / "run")
    assert_allclose(nd.load(tmp_path / "run").leg_forces, every.leg_forces, rtol=0.0)
    rows = np.genfromtxt(tmp_path / "run" / "legs.csv", delimiter=",", names=True)
    assert_allclose(rows["r2_force_3"], every.leg_forces[2, :, 7])
    assert_allclose(rows["l1_power_2"], every.leg_powers[1, :, 0], atol=1e-12)
    table = drives_table(every.to_dict())
    assert "each figure the largest of 3 loads" in table.title
    assert "all" not in plain_text(table)  # the largest do not add up
    with pytest.raises(ValueError, match="load: got stacks"):
        nd.follow(g, lifted.trajectory, HOME, load=(force[:, :, None], None), **how)


def test_a_power_says_its_unit_wherever_it_stands():
    """Force times speed, of the study's own units; watts only where masses make forces newtons."""
    study = nd.Study(
        variables={"a1": 0.0, "a2": 871.9, "b1": 435.9, "b2": 0.0, "zp": 597.4, "zs": 366.5},
        constraints={"power": (None, 9e4), "rate": (None, 250.0)},
        loads={"wrenches": [(0, 0, 0, 0, 0, -500.0)]},
        speeds={"linear": 100.0},
        characteristic_length=150.0,
        unit="mm",
    )
    result = nd.optimize(study)
    path = nd.Trajectory.line(result.configuration, (30.0, 0.0, 20.0), unit="mm")
    motion = nd.follow(result, path, load=((0, 0, 0), (0, 0, -500.0)))
    plain_motion = motion.to_dict() | {"limits": nd.path_limits(study, motion, result.configuration).worst()}
    _, drives, limits = motion_tables(plain_motion)
    assert [column.unit for column in drives.columns if column.name in ("power", "work")] == ["force mm/s", "force mm"]
    allowed = {row[0].split()[0]: row[2] for row in limits.rows if row}
    assert allowed == {"power": "90000 force mm/s", "rate": "250 mm/s"}
    with_masses = nd.follow(result, path, masses=MASSES)
    _, drives = motion_tables(with_masses.to_dict())
    assert [column.unit for column in drives.columns if column.name in ("power", "work")] == ["W", "J"]
