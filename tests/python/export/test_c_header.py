"""C: the header compiles without a warning and gives the leg lengths of the package."""

import shutil
import subprocess

import numpy as np
import pytest
from exported import machine
from scipy.spatial.transform import Rotation
from written_designs import PAPER, general, text_of

import ninedof as nd
from ninedof.export import c_header

COMPILER = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
needs_compiler = pytest.mark.skipif(COMPILER is None, reason="no C compiler (cc, gcc or clang)")
STRICT = "-std=c99 -O1 -Wall -Wextra -Werror -pedantic -Wshadow -Wconversion".split()
POSES = 200

LENGTHS = r"""
#include <stdio.h>
#include "robot.h"

int main(void) {
  ninedof_robot_pose pose = ninedof_robot_neutral;
  double lengths[9];
  do {
    int k;
    ninedof_robot_leg_lengths(&pose, lengths);
    for (k = 0; k < 9; ++k) printf("%.17g ", lengths[k]);
    printf("\n");
  } while (scanf("%lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf", &pose.p[0], &pose.p[1], &pose.p[2],
                 &pose.Q[0][0], &pose.Q[0][1], &pose.Q[0][2], &pose.Q[1][0], &pose.Q[1][1], &pose.Q[1][2],
                 &pose.Q[2][0], &pose.Q[2][1], &pose.Q[2][2], &pose.O[0], &pose.O[1], &pose.O[2]) == 15);
  return 0;
}
"""
NEEDED = r"""
#include <stdio.h>
#include "robot.h"

int main(void) {
  double lengths[9];
  int k = 0;
  while (scanf("%lf", &lengths[k]) == 1) {
    if (++k < 9) continue;
    k = 0;
    printf("%d ", ninedof_robot_first_out_of_range(lengths));
  }
  return 0;
}
"""


TWO = r"""
#include <stdio.h>
#include "arm-1.h"
#include "other.h"
#include "arm-1.h"

int main(void) {
  double first[9], second[9];
  ninedof_arm_1_leg_lengths(&ninedof_arm_1_neutral, first);
  ninedof_other_leg_lengths(&ninedof_other_neutral, second);
  printf("%s %.17g %s %.17g\n", ninedof_arm_1_name, first[0], ninedof_other_name, second[0]);
  return 0;
}
"""


def compiled(folder, program):
    """Compile a program of the folder to `main`."""
    (folder / "main.c").write_text(program)
    command = [COMPILER, *STRICT, "main.c", "-o", "main", "-lm"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def run(folder, design, program, source=""):
    """Compile a program that includes the header of a design; return what it prints."""
    (folder / "robot.h").write_text(text_of(c_header, design))
    built = compiled(folder, program)
    assert built.returncode == 0, built.stderr
    return subprocess.run(folder / "main", input=source, capture_output=True, text=True, check=True).stdout


@needs_compiler
@pytest.mark.parametrize("design", [PAPER, general(2)], ids=["paper", "general"])
def test_leg_lengths_are_those_of_the_package(design, tmp_path):
    rng = np.random.default_rng(5)
    size = float(design.configuration.position[2])
    p, s = size * (rng.normal(size=(2, POSES, 3)) + np.array([0.0, 0.0, 2.0]))
    poses = nd.Configuration(p, Rotation.random(POSES, random_state=6), s)
    rows = [
        np.r_[p, q.ravel(), s] for p, q, s in zip(poses.position, poses.rotation, poses.internal_point, strict=True)
    ]
    printed = run(tmp_path, design, LENGTHS, "\n".join(" ".join(map(repr, row.tolist())) for row in rows))
    neutral, *result = np.array([line.split() for line in printed.splitlines()], dtype=float)
    np.testing.assert_allclose(neutral, nd.leg_lengths(design.geometry, design.configuration), rtol=1e-15, atol=0.0)
    np.testing.assert_allclose(result, nd.leg_lengths(design.geometry, poses), rtol=1e-15, atol=0.0)


@needs_compiler
def test_the_range_of_a_run_is_what_its_poses_need(tmp_path):
    """And not what its study permits, which is wider."""
    result = machine()
    nd.export(result, "c", tmp_path / "robot.h")
    needed = nd.leg_lengths(result.geometry, result.best.configurations)
    low, high = needed.min(axis=0), needed.max(axis=0)
    rows = [*needed, low, high]
    for end, step in ((low, 1.0 - 1e-9), (high, 1.0 + 1e-9)):
        rows += [np.where(np.arange(9) == k, step * end, needed[0]) for k in range(9)]
    rows.append(np.where(np.arange(9) == 1, np.nan, needed[0]))
    assert compiled(tmp_path, NEEDED).returncode == 0
    text = "\n".join(" ".join(map(repr, row.tolist())) for row in rows)
    said = subprocess.run(tmp_path / "main", input=text, capture_output=True, text=True, check=True).stdout.split()
    assert list(map(int, said)) == [0] * (len(needed) + 2) + 2 * list(range(1, 10)) + [2]


@needs_compiler
def test_headers_of_two_machines_in_one_program(tmp_path):
    designs = {"arm-1": PAPER, "other": general(2)}
    for name, design in designs.items():
        (tmp_path / f"{name}.h").write_text(text_of(c_header, design, name))
    assert compiled(tmp_path, TWO).returncode == 0
    words = subprocess.run(tmp_path / "main", capture_output=True, text=True, check=True).stdout.split()
    assert words[::2] == list(designs)
    expected = [nd.leg_lengths(design.geometry, design.configuration)[0] for design in designs.values()]
    np.testing.assert_allclose([float(x) for x in words[1::2]], expected, rtol=1e-15)


@needs_compiler
def test_two_machines_of_one_name_do_not_compile(tmp_path):
    """With one guard for both the second would be left out, and the first machine's lengths taken for its own."""
    for name, design in {"a.h": PAPER, "b.h": general(2)}.items():
        (tmp_path / name).write_text(text_of(c_header, design))
    built = compiled(tmp_path, '#include "a.h"\n#include "b.h"\nint main(void) { return 0; }\n')
    assert built.returncode != 0
    assert "ninedof_robot_base_external" in built.stderr


def test_constants_read_back_to_the_same_bits():
    text = text_of(c_header, general(3))
    rows = text.partition("ninedof_robot_base_external[3][3] = {")[2].partition("};")[0]
    numbers = [float(x) for x in rows.replace("{", " ").replace("}", " ").replace(",", " ").split()]
    assert numbers == general(3).geometry.base_external.ravel().tolist()
    assert "shortest" not in text
