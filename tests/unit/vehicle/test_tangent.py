"""The water's stiffness: tangents against differences of the loads themselves, and closed forms."""

import numpy as np
import pytest

import antinode as an
from antinode.vehicle.loads import compute_loads
from antinode.vehicle.numbers import ManyCases
from antinode.vehicle.tangent import disk_share, disk_tangent, tangents
from cli_run import run

STEP = 1e-5


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tangent")
    run("init", "--example", "sweep", folder)
    return an.load_case(folder / "case.toml")


def changed(case, **condition):
    return case.condition.model_copy(update=condition)


def found(case, **changes):
    made = {"vehicle": case.vehicle, "condition": case.condition, "water": case.water}
    made |= {"model": case.model} | changes
    loads = compute_loads(*(made[k] for k in ("vehicle", "condition", "water", "model")))
    many = ManyCases(*(made[k] for k in ("vehicle", "condition", "water", "model")))
    return loads, {t.name: t for t in tangents(many, loads)}


def differences(make, step=STEP):
    """Central differences of arrays, with one Richardson step."""
    whole = (make(step) - make(-step)) / (2 * step)
    half = (make(step / 2) - make(-step / 2)) / step
    return (4 * half - whole) / 3


def turned(case, angle, **changes):
    """Loads of the body turned nose-up about its nose, the disk held against the flow."""
    theta, delta = case.condition.body_angle + angle, case.condition.cavitator_angle - angle
    condition = changed(case, body_angle=theta, cavitator_angle=delta)
    return found(case, condition=condition, **changes)[0]


MODELS = [
    {},
    {"planing_angle": "axis"},
    {"planing_angle": "attitude"},
    {"fin_immersion": "tip_distance"},
    {"planing_area": "projected", "gravity_rise": "buoyancy"},
    {"planing_position": "tail"},
]


@pytest.mark.parametrize("options", MODELS)
@pytest.mark.parametrize("theta", [0.004, -0.03])
def test_turning_the_whole_body_changes_the_forces_as_the_tangents_say(case, options, theta):
    model = an.Model(**options)
    base = case.model_copy(update={"condition": changed(case, body_angle=theta)})
    loads, by_name = found(base, model=model)

    def forces(angle):
        moved = turned(base, angle, model=model)
        return np.array([moved.F_fY, moved.F_PY, loads.F_PY * moved.x_P])

    fins, lift, moment = differences(forces)
    # nose up by 1 about the nose: Y = -x, psi = -1
    for name, slopes in (("fin set 1", [fins, 0.0]), ("planing", [lift, moment])):
        tangent = by_name[name]
        answer = -tangent.stiffness @ [-tangent.x, -1.0]
        assert answer == pytest.approx(slopes, rel=1e-6, abs=1e-6 * abs(slopes[0]) + 1e-3)


def test_raising_the_cavity_alone_changes_the_planing_force_as_the_tangent_says(case):
    _, by_name = found(case)
    tail = case.vehicle.length

    def of(gravity):
        water = case.water.model_copy(update={"gravity": gravity})
        return found(case, water=water)[0]

    def seen(step):
        moved = of(case.water.gravity * (1 + step))
        return np.array([moved.F_PY, moved.cavity.axis_offset(tail), moved.cavity.axis_slope(tail)])

    force, offset, slope = differences(seen, 1e-4)
    tangent = by_name["planing"]
    # the tail sees what it would if it sank by the offset and turned by the slope
    psi = -slope
    Y = -offset - (tail - tangent.x) * psi
    assert -tangent.stiffness[0] @ [Y, psi] == pytest.approx(force, rel=1e-6)


def test_the_starter(case):
    _, by_name = found(case)
    planing, fins = by_name["planing"], by_name["fin set 1"]
    assert planing.spring == pytest.approx(2.503e6, rel=1e-3)
    assert planing.x == pytest.approx(5.986, abs=5e-4)
    assert planing.dashpot == pytest.approx(1.29e3, rel=1e-3)
    assert planing.room == pytest.approx(2.77e-3, rel=1e-2)
    # four fins of a plate: q pi/2 times the wetted area, twice sin^2 of where they stand
    h = np.array(case.loads.fins[0].immersion)
    fin = case.vehicle.fins[0]
    chord = fin.chord or fin.tip_radius - float(case.vehicle.radius_at(np.array([5.0]))[0])
    q = case.water.density * case.condition.speed**2 / 2
    sine = np.sin(np.array(fin.roll_angles)) ** 2
    assert fins.following == pytest.approx(-q * fin.lift_slope * chord * (h * sine).sum())
    assert fins.dashpot == pytest.approx(-fins.following / case.condition.speed)


def test_the_disk(case):
    loads, V = case.loads, case.condition.speed

    def lift(angle):
        condition = changed(case, cavitator_angle=case.condition.cavitator_angle + angle)
        return np.array(found(case, condition=condition)[0].F_CY)

    assert disk_share(loads) * loads.F_CX == pytest.approx(float(differences(lift)), rel=1e-7)
    # F_x0 sin^2 alpha / V: a flow that comes from above meets a disk that lifts less squarely
    assert disk_tangent(loads, V).dashpot == pytest.approx(
        (loads.F_CX + loads.F_CY * np.tan(loads.cavity.alpha)) * np.sin(loads.cavity.alpha) ** 2 / V
    )


def test_no_contact_has_no_tangent(case):
    loads, by_name = found(case, condition=changed(case, cavitation_number=0.012))
    assert loads.F_PY == 0
    assert "planing" not in by_name


def test_options_switch_them_off(case):
    _, by_name = found(case, model=an.Model(planing="none", fin_lift="none"))
    assert set(by_name) == {"cavitator"}
