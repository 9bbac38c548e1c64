"""The forward's hand-written package and the generated one beside it can be imported, as when it runs."""

import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "designs" / "forward"), str(ROOT / "generated" / "python")]
