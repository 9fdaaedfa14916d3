"""kept_touchables.py SHOWER FIELD: the same events with touchables made at each boundary and kept."""
import csv
import re
import subprocess
import sys
import tempfile

shower, field = sys.argv[1:]


def events(touchables, threads):
    """Deposits, leakage and steps of each event, as text; how many touchables were kept, if told."""
    with tempfile.NamedTemporaryFile("r") as out:
        told = subprocess.run(
            [shower, "--energy", "0.5", "--events", "8", "--from", "0,0,-300", "--field", field,
             "--threads", str(threads), "--touchables", touchables, "--out", out.name],
            check=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
        assert "Ordering" not in told, told  # Geant4 would warn of two that are first
        rows = [{k: v for k, v in row.items() if k != "seconds"} for row in csv.DictReader(out)]
    kept = re.search(r"touchables: (\d+) kept", told)
    return rows, int(kept[1]) if kept else None


made, none = events("made", 1)
kept, count = events("kept", 1)
assert len(made) == 8 and none is None
assert kept == made, (kept, made)
assert count is not None and count > 10000, count
assert events("kept", 3)[0] == events("made", 3)[0]
print(f"{sum(int(e['steps']) for e in made)} steps, {count} touchables kept")
