#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""`tools/measure.py --check` finds what it is there for: an empty group, a figure without a commit, an unknown group."""
import importlib.util
import sys
from pathlib import Path

spec = importlib.util.spec_from_file_location("measure", Path(__file__).resolve().parents[2] / "tools/measure.py")
measure = importlib.util.module_from_spec(spec)
spec.loader.exec_module(measure)
measure.TO_COME = ("page",)


def records(**changes):
    good = dict(figure="rate", input="cones", value=1, unit="", bar="", how="by hand", commit="1234567", date="2026-01-01")
    return [dict(good, group=group, **changes) for group in measure.GROUPS if group != "page"]


def expect(found, *words):
    found = list(found)
    if len(found) != len(words) or any(word not in fault for word, fault in zip(words, found)):
        sys.exit(f"expected {words}, found {found}")


expect(measure.faults_of(records()))
expect(measure.faults_of(records()[1:]), "the group setup has no figure")
expect(measure.faults_of(records() + records(commit="")[:1]), "its commit is missing")
expect(measure.faults_of(records() + [dict(records()[0], group="page")]), "take it off TO_COME")
expect(measure.faults_of(records() + [dict(records()[0], group="weather")]), "there is no group weather")
if missing := [group for group in measure.GROUPS if group not in measure.RUNS and group not in measure.BY_HAND]:
    sys.exit(f"no function measures {missing}")
if "Not measured" not in measure.table_of(records()):
    sys.exit("the table does not say that a group is not measured")
