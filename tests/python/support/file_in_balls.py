"""Certificates of designs and of workspaces as the second checker reads them: lines by their first word."""

import math
import re
import zlib

FIRST = re.compile(rb"ninedof certificate of (designs|a workspace) 1\nchecksum ([0-9a-f]+)\n")
NUMBER = re.compile(r"-?(0x[0-9a-f](\.[0-9a-f]+)?p[+-][0-9]+|inf)")
FORM = {  # of what follows the first word: x a number, w another word
    **{"family": "w", "tool": "x{6}", "characteristic_length": "x", "region": "wx{5}ww", "shares": "x{3}"},
    **{"home": "x{15}", "space": "x{6}", "internal_point": "wx{4}", "allowed_with": "w", "volume": "xx"},
    **{"weights": "x{8}", "speeds": "xxw"},
}
FORM_OF_MANY = {
    **{"variable": "wxx", "corner": "x{3}", "pose": "x{9}w", "joint": "x{3}", "rotation": "x{9}", "leg": "x{4}"},
    **{"load": "x{9}", "limit": "wxxwwx{3}", "exempt": "w", "box": "x*w(wwx{6}wx{6})?"},
}
PLATES = ("base_external", "base_internal", "platform_external", "platform_internal")


class Refused(ValueError):
    """The file is no proof."""


def need(true, why):
    if not true:
        raise Refused(why)


def read(word):
    if not NUMBER.fullmatch(word):
        return word
    x = float.fromhex(word)
    need(abs(x) <= 1e100 or math.isinf(x), f"{word} is too large")
    return x


def read_file(data):
    try:
        return File(data)
    except Refused:
        raise
    except (ValueError, LookupError) as error:  # of reading alone: a fault of what checks is none of the file
        raise Refused(error) from None


class File:
    def __init__(self, data):
        first = FIRST.match(data)
        need(first, "no certificate of designs or of a workspace")
        body, self.space = data[first.end() :], first[1] != b"designs"
        need(int(first[2], 16) == zlib.crc32(body), "the checksum does not agree")
        head, _, tree = body.partition(b"\ntree ") if self.space else (body, b"", b"")
        size, _, self.tree = tree.partition(b"\n")
        need(not self.space or len(self.tree) == int(size), "the tree is too short or too long")
        self.lines = {key: [] for key in (FORM | FORM_OF_MANY)}
        for key, *words in (line.split(" ") for line in head.decode("ascii").splitlines()):
            row = [read(word) for word in words]
            kinds = "".join("x" if isinstance(x, float) else "w" for x in row)
            need(re.fullmatch((FORM | FORM_OF_MANY).get(key, "-"), kinds), f"a line {key} is none")
            self.lines[key].append(row)
        self.varied = [k for k, (_, low, high) in enumerate(self["variable"]) if low < high]
        self.exempt = {int(n) for (n,) in self["exempt"]}
        (self._need_robot if self.space else self._need_designs)()

    def __getitem__(self, key):
        """The one line of a key, or all of them where there may be many."""
        need(key in FORM_OF_MANY or len(self.lines[key]) == 1, f"there is not one line {key}")
        return self.lines[key] if key in FORM_OF_MANY else self.lines[key][0]

    def _need_robot(self):
        need(len(self["joint"]) == 12 and self["rotation"] and self["allowed_with"][0] in ("some", "all"), "no robot")

    def _need_designs(self):
        names, low, high = zip(*self["variable"], strict=True)
        need([*names] == names_of(*self["family"]), "the variables are not those of the family")
        need(all(-math.inf < a <= b < math.inf for a, b in zip(low, high, strict=True)), "a variable has no bounds")
        shape, *sizes = self["region"][:6]
        need(shape in ("none", "box", "ball", "cylinder", "path") and min(sizes) >= 0.0, "no region")

    def need_duty(self):
        weights, legs, (*speeds, rule) = self["weights"], self["leg"], self["speeds"]
        need(len(legs) == 9 and self["load"] and rule in ("shifted", "carried", "held", "least"), "no duty")
        least = [weights[3], weights[7], *(x for leg in legs for x in leg[::2]), *speeds]
        need(all(0.0 <= x < math.inf for x in least), "a mass or a speed is none")


def names_of(family):
    """The variables of a family in their order, none of an unknown one."""
    if family == "hexagonal":
        return ["a1", "a2", "b1", "b2", "zp", "zs", "theta_z"]
    if family == "general":
        return [f"{t}_{k}_{a}" for t in PLATES for k in (1, 2, 3) for a in "xyz"] + ["zp", "zs", "theta_z"]
    names = [f"{t}_{what}" for t in PLATES for what in ("radius", "angle")]
    names = [n for n in names if n != "base_external_angle"] + ["zp", "zs"]
    return {"symmetric": names, "symmetric_nonplanar": names + [f"{t}_height" for t in PLATES]}.get(family, [])
