"""Print the JSON Schema of design files, for editors that complete YAML."""

import argparse
import json


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `vicode schema`."""
    parser.add_argument("--project", action="store_true", help="that of project.yaml")


def run(args: argparse.Namespace) -> int:
    """Print the schema."""
    from vicode.store import design_schema, project_schema

    schema = project_schema() if args.project else design_schema()
    print(json.dumps(schema, indent=2, ensure_ascii=False))
    return 0
