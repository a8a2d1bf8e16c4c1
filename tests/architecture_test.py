"""The picture of the rooms is the one that cmake/layers.txt gives, and the files in the walks of
docs/architecture.md exist, each named once."""
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parent.parent
failed = subprocess.run([sys.executable, root / "tools/draw_rooms.py", "--check"],
                        check=False).returncode != 0
walks = re.split(r"^## ", (root / "docs/architecture.md").read_text(), flags=re.MULTILINE)[1:]
for walk in walks:
    title = walk.splitlines()[0]
    files = re.findall(r"^\d+\. `([^`]+)`", walk, flags=re.MULTILINE)
    for name in files:
        if not (root / "src/heddle" / name).exists() or files.count(name) != 1:
            print(f"docs/architecture.md, {title}: `{name}` does not exist, or is named twice")
            failed = True
    if not 10 <= len(files) <= 25:
        print(f"docs/architecture.md, {title}: {len(files)} files, expected 10 to 25")
        failed = True
sys.exit(failed or len(walks) != 2)
