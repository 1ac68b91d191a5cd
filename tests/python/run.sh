#!/bin/sh
# Builds the Python package, installs it in a new environment as a user does, and tests it there.
# With CLUSTERS=1 also on Ray, Spark (which needs Java) and MPI (which needs mpiexec), whose packages are 0.9 GB.
set -eu
cd "$(dirname "$0")/../.."
environment="$PWD/target/python"
PATH="$environment/bin:$PATH"
export PATH
{ python3 -m venv --clear "$environment" &&
    pip install --quiet --disable-pip-version-check pytest mypy ruff pandas "maturin>=1.9,<2"; } || {
    echo "note: the tools for the Python package are not here: it is not built"
    exit 0
}
# what cannot be had its tests say they skip
optional="scipy pyarrow distributed"
[ "${CLUSTERS-0}" = 0 ] || optional="$optional ray pyspark mpi4py"
for package in $optional; do
    pip install --quiet --disable-pip-version-check "$package" || echo "note: $package is not here"
done
# built as tests are: a release takes minutes longer, and says the same
MATURIN_PEP517_ARGS="${MATURIN_PEP517_ARGS---profile dev}" \
    pip install --quiet --disable-pip-version-check --no-build-isolation .
ruff check src/python tests/python benches/python
ruff format --check src/python tests/python benches/python
mypy src/python/linkwork
# away from the sources, so that what is imported is what was installed
tests="$PWD/tests/python"
cd "$environment"
pytest -q -rs --rootdir "$tests" -p no:cacheprovider "$tests"
