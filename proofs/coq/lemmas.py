#!/usr/bin/env python3
"""Lemmas of the rule `sum`, from certificates, in the words of theories/Reflect.v.

    lemmas.py coq FILE.proof PLACE     one lemma, as a file of Coq whose theorem is that the checker accepts it
    lemmas.py ocaml FILE.proof...      all lemmas that can be said, for the extracted checker; what cannot is counted on stderr

This script is not trusted: what it writes down wrongly, the checker refuses, or it proves another lemma. A claim
(claims/) says in the program's own words what was proved.

The checker takes formulas of single variables, +, -, * and changes of sign in which each rounded step has the bound h
of proof.md, "Formulas without divisions". Left out are lemmas with cuts, parts, steps of the second kind (`relative`),
sums of variables, ends that are no mirror images (`down-to`), and more than 12 variables.
"""

import itertools
import sys
from collections import Counter
from fractions import Fraction

MOST_VARIABLES = 12


class LeftOut(Exception):
    """A lemma that the checker cannot say, and why."""


def number(word):
    """A number of a certificate: an integer, perhaps times a power of two."""
    mantissa, _, exponent = word.partition("*2^")
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent or 0)


def binary(x):
    """Mantissa and exponent of a binary fraction."""
    return x.numerator, -(x.denominator.bit_length() - 1)


def exponent_of(x):
    """The least e with x <= 2^e."""
    e = x.numerator.bit_length() - x.denominator.bit_length() - 1
    while Fraction(2) ** e < x:
        e += 1
    return e


class Lemma:
    """A lemma as it stands in a certificate."""

    def __init__(self, path, words, digits, smallest, domain, operations):
        self.name = f"{path.rsplit('/', 1)[-1]} {words[0][1]}"
        self.place = words[0][1]
        self.digits, self.smallest = digits, smallest
        self.domain, self.operations = domain, operations
        self.variables = [line for line in words if line[0] == "variable"]
        self.steps = [line for line in words if line[0] == "step"]
        self.others = {line[0] for line in words[1:]} - {"variable", "step"}
        numbers = {line[0]: line[1] for line in words if line[0] in ("first", "rest", "error")}
        if {"first", "rest", "error"} <= set(numbers):
            self.first, self.rest, self.error = (number(numbers[key]) for key in ("first", "rest", "error"))
        self.text = str((words[1:], [operations[int(step[1])][0] for step in self.steps]))


def lemmas_of(path):
    """The lemmas of the rule `sum` of a certificate."""
    digits = smallest = domain = None
    operations, words = {}, None
    for line in open(path, encoding="utf-8"):
        line = line.split()
        match line[0]:
            case "format":
                digits, smallest = int(line[1]), int(line[2])
            case "domain":
                domain = {line[i]: number(line[i + 1]) for i in range(1, len(line), 2)}
            case "program":
                operations = {}
            case "op":
                operations[int(line[1])] = line[2:]
            case "lemma":
                words = [line] if line[2] == "sum" else None
            case _ if words is not None:
                words.append(line)
                if line[0] == "error":
                    yield Lemma(path, words, digits, smallest, domain, operations)
                    words = None


class Term:
    """A formula with its values at all corners, its size, and the error of its operands: of first order and higher."""

    def __init__(self, formula, values, size, first=Fraction(0), higher=Fraction(0)):
        self.formula, self.values, self.size = formula, values, size
        self.first, self.higher = first, higher

    def __neg__(self):
        return Term(("XNeg", self.formula), [-x for x in self.values], self.size, self.first, self.higher)

    def plus(self, other, name, sign):
        values = [x + sign * y for x, y in zip(self.values, other.values)]
        formula = (name, self.formula, other.formula)
        return Term(formula, values, self.size + other.size, self.first + other.first, self.higher + other.higher)

    def __add__(self, other):
        return self.plus(other, "XAdd", 1)

    def __sub__(self, other):
        return self.plus(other, "XSub", -1)

    def __mul__(self, other):
        values = [x * y for x, y in zip(self.values, other.values)]
        first = self.size * other.first + self.first * other.size
        error = other.size + other.first + other.higher
        higher = self.first * other.first + self.higher * error + (self.size + self.first) * other.higher
        return Term(("XMul", self.formula, other.formula), values, self.size * other.size, first, higher)


class Said:
    """A lemma in the checker's words: bounds of variables, rounded steps, their sizes and exponents."""

    def __init__(self, lemma):
        if unknown := lemma.others - {"corner", "first", "rest", "error", "size", "computed"}:
            raise LeftOut(min(unknown))
        self.lemma = lemma
        self.bounds = [self.bound(line) for line in lemma.variables]
        if len(self.bounds) > MOST_VARIABLES:
            raise LeftOut(f"more than {MOST_VARIABLES} variables")
        self.steps, self.sizes, self.exponents = [], [], []
        corners = list(itertools.product(*[(bound, -bound) for bound in self.bounds]))
        terms = []
        for line in lemma.steps:
            term, is_rounded = self.term(line, terms, corners)
            terms.append(self.rounded(term) if is_rounded else term)
        if not terms or terms[-1].formula != ("XStep", len(self.steps) - 1):
            raise LeftOut("an exact last step")

    def bound(self, line):
        domain = self.lemma.domain
        match line[1]:
            case "difference":
                # Point 0 is the ray's origin.
                return domain["reach" if "0" in line[2:4] else "edge"]
            case "point":
                return domain["world"]
            case "direction":
                return domain["direction"]
            case "end":
                return domain["extent"]
            case kind:
                raise LeftOut(kind)

    def term(self, line, terms, corners):
        """The value of a step before it is rounded, and whether it is rounded."""
        _, place, kind, *operands = line
        match kind:
            case "variables":
                if len(operands) != 1 or operands[0][0] != "+":
                    raise LeftOut("a sum of variables")
                variable = int(operands[0][1:])
                values = [corner[variable] for corner in corners]
                is_difference = self.lemma.operations[int(place)][0] == "sub"
                return Term(("XVar", variable), values, self.bounds[variable]), is_difference
            case "number":
                value = int(operands[0])
                return Term(("XNum", value), [Fraction(value)] * len(corners), Fraction(abs(value))), False
        a, *more = (terms[int(operand)] for operand in operands)
        match kind:
            case "neg":
                return -a, False
            case "mul":
                return a * more[0], True
            case "add":
                return a + more[0], True
            case "sub":
                return a - more[0], True
            case "fma":
                return a * more[0] + more[1], True
            case _:
                raise LeftOut(kind)

    def rounded(self, term):
        """The term as a step of its own, with its bound h."""
        size = max(abs(value) for value in term.values)
        if size == 0:
            raise LeftOut("a step that is zero")
        exponent = exponent_of(size + term.first + term.higher)
        self.steps.append(term.formula)
        self.sizes.append(size)
        self.exponents.append(exponent)
        h = Fraction(2) ** (max(exponent - self.lemma.digits, self.lemma.smallest) - 1)
        step = ("XStep", len(self.steps) - 1)
        return Term(step, term.values, size, term.first + h, term.higher)


class Coq:
    """Terms as Coq writes them."""

    separator = ";"

    def integer(self, n):
        return f"({n})"

    def binary(self, x):
        mantissa, exponent = binary(x)
        return f"(dy ({mantissa}) ({exponent}))"

    def formula(self, formula):
        match formula:
            case ("XStep", k):
                return f"s{k}"
            case (name, int(n)):
                return f"({name} ({n}))" if name == "XNum" else f"({name} {n})"
            case (name, *parts):
                return f"({name} {' '.join(self.formula(part) for part in parts)})"


class OCaml(Coq):
    """Terms of the extracted program."""

    def integer(self, n):
        return f"(integer ({n}))"

    def binary(self, x):
        mantissa, exponent = binary(x)
        return f"(binary ({mantissa}) ({exponent}))"

    def formula(self, formula):
        match formula:
            case ("XStep", k):
                return f"s{k}"
            case ("XNum", n):
                return f"(XNum (integer ({n})))"
            case ("XVar", n):
                return f"(XVar {n})"
            case ("XNeg", part):
                return f"(XNeg {self.formula(part)})"
            case (name, *parts):
                return f"({name} ({', '.join(self.formula(part) for part in parts)}))"


def record(said, language, assign):
    """A record `cert` of Reflect.v."""
    lemma = said.lemma

    def many(write, items):
        return "[" + "; ".join(write(item) for item in items) + "]"

    fields = {
        "p": language.integer(lemma.digits),
        "smin": language.integer(lemma.smallest),
        "ends": many(lambda b: f"({language.binary(-b)}, {language.binary(b)})", said.bounds),
        "sizes_of_vars": many(language.binary, said.bounds),
        "steps": many(lambda k: f"b{k}", range(len(said.steps))),
        "sizes": many(language.binary, said.sizes),
        "exps": many(language.integer, said.exponents),
        "first": language.binary(lemma.first),
        "rest": language.binary(lemma.rest),
        "error": language.binary(lemma.error),
    }
    return "{| " * (assign == ":=") + "{ " * (assign == "=") + ";\n  ".join(
        f"{name} {assign} {value}" for name, value in fields.items()
    ) + (" |}" if assign == ":=" else " }")


def write_coq(path, place):
    said = next(Said(lemma) for lemma in lemmas_of(path) if lemma.place == place)
    language = Coq()
    print(f"(* The lemma of number {place} of {path.rsplit('/', 1)[-1]}. Written by lemmas.py. *)")
    print("From Coq Require Import ZArith List.\nFrom Hairline Require Import Reflect.")
    print("Import ListNotations.\nOpen Scope Z_scope.")
    for k, step in enumerate(said.steps):
        print(f"Definition b{k} := {language.formula(step)}.\nDefinition s{k} := XStep {k} b{k}.")
    print(f"Definition the : cert := {record(said, language, ':=')}.")
    print("Theorem holds : check the = true.\nProof. vm_compute. reflexivity. Qed.")


def write_ocaml(paths):
    language = OCaml()
    seen, left_out, count = set(), Counter(), 0
    for path in paths:
        for lemma in lemmas_of(path):
            count += 1
            key = (lemma.digits, lemma.smallest, str(lemma.domain), lemma.text)
            try:
                said = Said(lemma)
            except LeftOut as why:
                left_out[str(why)] += 1
                continue
            if key in seen:
                left_out["said before"] += 1
                continue
            seen.add(key)
            print(f'let () = lemma "{lemma.name}" (fun () ->')
            for k, step in enumerate(said.steps):
                print(f"  let b{k} = {language.formula(step)} in let s{k} = XStep ({k}, b{k}) in ignore s{k};")
            print(f"  {record(said, language, '=')})")
    print("let () = finish ()")
    told = ", ".join(f"{why} {n}" for why, n in left_out.most_common())
    print(f"{count} lemmas of the rule `sum`: {len(seen)} are said; left out: {told}", file=sys.stderr)


def main():
    match sys.argv[1:]:
        case ["coq", path, place]:
            write_coq(path, place)
        case ["ocaml", *paths] if paths:
            write_ocaml(paths)
        case _:
            sys.exit(__doc__)


main()
