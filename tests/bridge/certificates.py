"""Certificates for tests with TLS."""

import shutil
import subprocess
from pathlib import Path

_COMMAND = ("openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days", "2")
_NAMES = ("-subj", "/CN=localhost", "-addext", "subjectAltName=IP:127.0.0.1")


def make_certificate(folder: Path) -> Path | None:
    """Make a certificate of this machine with its key, in one file; None if there is no program for it."""
    if shutil.which("openssl") is None:
        return None
    certificate, key = folder / "cert.pem", folder / "key.pem"
    command = [*_COMMAND, *_NAMES, "-keyout", str(key), "-out", str(certificate)]
    subprocess.run(command, check=True, capture_output=True)
    certificate.write_bytes(certificate.read_bytes() + key.read_bytes())
    return certificate
