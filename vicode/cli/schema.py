"""Print the JSON Schema of design files, project.yaml or traces."""

import argparse
import json


def add_arguments(parser: argparse.ArgumentParser) -> None:
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--project", action="store_true", help="print the schema of project.yaml instead")
    which.add_argument("--trace", action="store_true", help="print the schema of the lines of a trace instead")


def run(args: argparse.Namespace) -> int:
    from vicode.store import design_schema, project_schema
    from vicode.traces.reader import trace_schema

    schema = project_schema() if args.project else trace_schema() if args.trace else design_schema()
    print(json.dumps(schema, indent=2, ensure_ascii=False))
    return 0
