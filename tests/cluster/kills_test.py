"""The tests with kills alone, for every night. The arguments are those of support.py."""
import sys
import unittest

from mpi_test import Mpi
from parts_test import Parts
from slurm_test import Slurm

__all__ = ["Mpi", "Parts", "Slurm"]

if __name__ == "__main__":
    kills = ["Parts.test_kills", "Mpi.test_ranks_are_killed", "Slurm.test_tasks_and_a_node_are_killed"]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], defaultTest=kills, verbosity=2)
