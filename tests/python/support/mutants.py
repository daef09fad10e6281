"""Files that were damaged, or written by somebody who had it in for us: mutations that know the structure."""

import copy

import tomli_w

NUMBERS = [0, -1, 1, 3.5, -2.5, 1e-300, 5e-324, 1e300, -1e300, 2**31, 2**63, 10**30, -(2**70), 0.1 + 0.2]
FLOATS = [float("nan"), float("inf"), float("-inf")]
TEXTS = ["", "x", "mm", "inf", "nan", "\u202e\u0000\x1b[2J", "a" * 3000, "../../x", "é\n", "hexagonal", "best"]
ODD = [True, False, [], {}, [1, [2, [3, {}]]], {"min": 1.0}, [1.0, 2.0], [[]], ["a", 1]]


def deep(depth, kind):
    out = 1.0
    for _ in range(depth):
        out = [out] if kind else {"a": out}
    return out


def paths(value, at=()):
    """Every place in nested tables and lists."""
    yield at
    entries = value.items() if isinstance(value, dict) else enumerate(value[:8]) if isinstance(value, list) else ()
    for key, entry in entries:
        yield from paths(entry, (*at, key))


def mutated(value, pick):
    """Nested values with one to three changes."""
    value = copy.deepcopy(value)
    for _ in range(pick.choice([1, 1, 1, 2, 3])):
        places = [path for path in paths(value) if path]
        if not places:
            return value
        path = pick.choice(places)
        holder = value
        for key in path[:-1]:
            holder = holder[key]
        _change(holder, path[-1], pick)
    return value


def _change(holder, key, pick):
    old = holder[key]
    kind = pick.randrange(12)
    if kind == 0:
        del holder[key]
    elif kind == 1 and isinstance(holder, dict):
        holder[pick.choice([str(key) + "x", str(key)[:-1], str(key).upper(), f"{key}_deg", pick.choice(TEXTS)])] = old
        holder.pop(key) if pick.random() < 0.7 and key in holder else None
    elif kind == 1:
        holder.insert(key, copy.deepcopy(old))
    elif kind == 2 and isinstance(old, list):
        holder[key] = [*old, *copy.deepcopy(old)] if pick.random() < 0.5 else old[:-1]
    elif kind == 3 and isinstance(old, list | dict):
        holder[key] = list(old.values()) if isinstance(old, dict) else {str(k): v for k, v in enumerate(old)}
    elif kind == 4:
        holder[key] = deep(pick.choice([1, 3, 60]), pick.random() < 0.5)
    elif kind == 5 and isinstance(old, int | float) and not isinstance(old, bool):
        holder[key] = pick.choice([-old, old * 1000.0, str(old), [old], old + 1])
    elif kind == 6:
        holder[key] = pick.choice(FLOATS)
    elif kind == 7:
        holder[key] = pick.choice(TEXTS)
    elif kind == 8:
        holder[key] = copy.deepcopy(pick.choice(ODD))
    elif kind == 9:
        holder[key] = [pick.choice(NUMBERS)] * pick.choice([1, 3, 9, 5000])
    else:
        holder[key] = pick.choice(NUMBERS)


def torn(data, pick):
    """Bytes with a few of them changed, lost, doubled or put in."""
    data = bytearray(data)
    for _ in range(pick.choice([1, 1, 2, 8])):
        if not data:
            break
        k = pick.randrange(len(data))
        kind = pick.randrange(6)
        if kind == 0:
            data[k] ^= 1 << pick.randrange(8)
        elif kind == 1:
            del data[k:]
        elif kind == 2:
            del data[k : k + pick.randrange(1, 20)]
        elif kind == 3:
            data[k:k] = data[k : k + pick.randrange(1, 200)]
        elif kind == 4:
            data[k:k] = pick.choice(
                [b"\0", b"\xff\xfe", b"[" * 2000, b'"', b"\n\n", b"=", b"\x1b[2J", b"1e999", b"{" * 50]
            )
        else:
            data[k] = pick.randrange(256)
    return bytes(data)


def toml_mutant(data, pick):
    import tomllib

    if pick.random() < 0.3:
        return torn(data, pick)
    try:
        return tomli_w.dumps(mutated(tomllib.loads(data.decode()), pick)).encode("utf-8", "surrogatepass")
    except (TypeError, ValueError, RecursionError):  # no TOML has such values
        return torn(data, pick)


def csv_mutant(data, pick):
    if pick.random() < 0.4:
        return torn(data, pick)
    rows = mutated([line.split(",") for line in data.decode().splitlines()], pick)
    return "\n".join(",".join(map(str, row)) if isinstance(row, list) else str(row) for row in rows).encode()
