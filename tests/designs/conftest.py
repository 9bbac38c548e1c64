"""Hand-written packages of the designs and the generated ones beside them can be imported, as when they run."""

import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "designs" / "forward"), str(ROOT / "designs" / "rescue"), str(ROOT / "generated" / "python")]
