"""Polynomials with integer coefficients: their signs, and Sturm's chains, which count their roots exactly."""

from __future__ import annotations

from itertools import pairwise
from math import gcd
from typing import TypeAlias

__all__ = [
    "Polynomial",
    "derivative",
    "odd_part",
    "primitive",
    "product",
    "sign_after",
    "sturm_chain",
    "value_at",
    "variations",
]

Polynomial: TypeAlias = list[int]
"""Coefficients from the constant on; the last is not 0, and [] is 0."""


def variations(chain: list[Polynomial], numerator: int, denominator: int) -> int:
    """The changes of sign along a chain, just after numerator / denominator."""
    signs = [sign_after(f, numerator, denominator) for f in chain]
    return sum(one != other for one, other in pairwise(signs))


def sign_after(f: Polynomial, numerator: int, denominator: int) -> int:
    """The sign of f just after a point: of the first of f, f', f'', ... that is not 0 there."""
    while f:
        value = value_at(f, numerator, denominator) if numerator else f[0]
        if value:
            return 1 if value > 0 else -1
        f = derivative(f)
    return 0


def value_at(f: Polynomial, numerator: int, denominator: int) -> int:
    """f(numerator / denominator) times a power of the denominator (positive)."""
    value, power = 0, 1
    for coefficient in reversed(f):
        value = value * numerator + coefficient * power
        power *= denominator
    return value


def derivative(f: Polynomial) -> Polynomial:
    """f'."""
    return [k * coefficient for k, coefficient in enumerate(f)][1:]


def product(f: Polynomial, g: Polynomial) -> Polynomial:
    """f g."""
    if not f or not g:
        return []
    result = [0] * (len(f) + len(g) - 1)
    for i, one in enumerate(f):
        for j, other in enumerate(g):
            result[i + j] += one * other
    return result


def primitive(f: Polynomial) -> Polynomial:
    """f without leading zeros and common factors; signs stay."""
    while f and f[-1] == 0:
        f = f[:-1]
    content = gcd(*f)
    return [coefficient // content for coefficient in f]


def _divided(f: Polynomial, g: Polynomial) -> tuple[Polynomial, Polynomial]:
    """Quotient and remainder of f by g, each up to a positive factor."""
    lead, sign = abs(g[-1]), 1 if g[-1] > 0 else -1
    quotient = [0] * max(len(f) - len(g) + 1, 0)
    while len(f) >= len(g):
        top, shift = sign * f[-1], len(f) - len(g)
        quotient = [lead * coefficient for coefficient in quotient]
        quotient[shift] = top
        f = [lead * coefficient for coefficient in f]
        for k, coefficient in enumerate(g):
            f[k + shift] -= top * coefficient
        f = f[:-1]
    return primitive(quotient), primitive(f)


def sturm_chain(f: Polynomial, g: Polynomial) -> list[Polynomial]:
    """f, g and so on: each the negative remainder of the two before it, as Sturm has it. Ends with gcd(f, g)."""
    chain = [primitive(f)]
    g = primitive(g)
    while g:
        chain.append(g)
        g = [-coefficient for coefficient in _divided(chain[-2], g)[1]]
    return chain


def odd_part(f: Polynomial) -> Polynomial:
    """The product of the factors of odd multiplicity, each once: f over a square, its roots where f changes sign."""
    rest = sturm_chain(f, derivative(f))[-1]
    if len(rest) <= 1 or len(f) <= 1:
        return f
    factors, _ = _divided(f, rest)  # every factor once; `rest` has it once less than f
    odd, multiplicity = [1], 1
    while len(factors) > 1:
        repeated = sturm_chain(rest, factors)[-1]
        if multiplicity % 2 == 1:
            odd = product(odd, _divided(factors, repeated)[0])
        factors, rest = repeated, _divided(rest, repeated)[0]
        multiplicity += 1
    return odd if (odd[-1] > 0) == (f[-1] > 0) else [-coefficient for coefficient in odd]
