"""Hand-written packages of the designs and the generated ones beside them can be imported, as when they run."""

import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
DESIGNS = [str(ROOT / "designs" / name) for name in ("forward", "rescue", "meeting", "soccer2d", "styles", "team")]
sys.path[:0] = [*DESIGNS, str(ROOT / "generated" / "python"), str(Path(__file__).parent)]
