#!/usr/bin/env python3
"""validate_files.py SCHEMA FILE.toml...: a line for each mistake that the JSON schema sees."""
import json
import sys
import tomllib

import jsonschema

with open(sys.argv[1], encoding="utf-8") as file:
    schema = json.load(file)
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
mistakes = 0
for name in sys.argv[2:]:
    with open(name, "rb") as file:
        document = tomllib.load(file)
    for error in validator.iter_errors(document):
        place = ".".join(str(part) for part in error.absolute_path)
        print(f"{name}: {place}: {error.message}")
        mistakes += 1
sys.exit(min(mistakes, 1))
