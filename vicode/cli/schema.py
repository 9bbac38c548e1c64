"""Print the JSON Schema of design files."""

import argparse
import json


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--project", action="store_true", help="print the schema of project.yaml instead")


def run(args: argparse.Namespace) -> int:
    from vicode.store import design_schema, project_schema

    schema = project_schema() if args.project else design_schema()
    print(json.dumps(schema, indent=2, ensure_ascii=False))
    return 0
