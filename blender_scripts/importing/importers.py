"""Runs one of Blender's importers and says in plain words why it gave up."""
from core.task import Refusal

REMEDY = "import it in Blender and save it as .blend, or see what a validator says of it"


def run_importer(kind, path, call):
    try:
        finished = call()
    except (AttributeError, RuntimeError) as error:
        raise Refusal(f"{path}: Blender's {kind} importer gave up: {cause_of(error)}; {REMEDY}") from error
    if "FINISHED" not in finished:
        raise Refusal(f"{path}: Blender's {kind} importer refused the file; {REMEDY}")


def cause_of(error):
    """The last line that says what went wrong: behind it an operator's error says where in its code ("Location:")."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    lines = [line for line in lines if not line.startswith(("Location:", "File ", "^"))]
    return lines[-1].replace("Error: ", "", 1) if lines else repr(error)
