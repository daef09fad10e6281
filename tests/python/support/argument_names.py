"""The names of the arguments of a function, those of options too that it takes as keywords of a declared kind."""

import inspect
import sys
from typing import get_args, get_type_hints


def argument_names(function):
    names = []
    for name, one in inspect.signature(function).parameters.items():
        if one.kind is one.VAR_KEYWORD and "Unpack[" in str(one.annotation):
            hints = get_type_hints(function, vars(sys.modules[function.__module__]))
            names += get_args(hints[name])[0].__annotations__
        elif one.kind not in (one.VAR_KEYWORD, one.VAR_POSITIONAL):
            names.append(name)
    return names
