# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""validate_json.py SCHEMA FILE...: exits 0 if every file meets the schema, else 1 with the first reason for each."""
import json
import sys

import jsonschema

with open(sys.argv[1], encoding="utf-8") as stream:
    schema = json.load(stream)
validator = jsonschema.validators.validator_for(schema)(schema, format_checker=jsonschema.FormatChecker())
failed = False
for path in sys.argv[2:]:
    with open(path, encoding="utf-8") as stream:
        errors = sorted(validator.iter_errors(json.load(stream)), key=lambda error: list(map(str, error.absolute_path)))
    for error in errors[:1]:
        failed = True
        print(f"{path}: {'/'.join(map(str, error.absolute_path))}: {error.message[:200]}")
sys.exit(1 if failed else 0)
