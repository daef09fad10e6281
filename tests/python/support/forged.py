"""Certificates of sets of designs that are changed and sealed anew."""

import math
import zlib

import ninedof as nd

FIRST = "ninedof certificate of designs 1\nchecksum "


def sealed(lines):
    """The bytes of a file of these lines."""
    body = "".join(f"{line}\n" for line in lines).encode()
    return f"{FIRST}{zlib.crc32(body):x}\n".encode() + body


def verdict_of(data, folder):
    """What the checker says of the bytes of a file."""
    path = folder / "forged.certificate"
    path.write_bytes(data)
    return nd.check_certificate(path)


def lines_of(data):
    """The lines below the checksum."""
    return data.decode().splitlines()[2:]


def spelled(x):
    """As the file has it: hexadecimal without needless digits."""
    if math.isinf(x):
        return "inf" if x > 0.0 else "-inf"
    mantissa, exponent = float(x).hex().split("p")
    return f"{mantissa.rstrip('0').rstrip('.') if '.' in mantissa else mantissa}p{exponent}"


def with_word(lines, n, place, word):
    words = lines[n].split(" ")
    words[place] = word
    return [*lines[:n], " ".join(words), *lines[n + 1 :]]


def line_of(lines, start):
    return next(n for n, line in enumerate(lines) if line.startswith(start))
