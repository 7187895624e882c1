"""Sparse matrices put together from equal blocks, one a stage."""

from __future__ import annotations

import casadi as ca
import numpy as np


class BlockAssembly:
    """Collects blocks of nonzeros and gathers them into one sparse matrix of MX."""

    def __init__(self, rows: int, columns: int) -> None:
        self.shape = (rows, columns)
        self.rows: list[np.ndarray] = []
        self.columns: list[np.ndarray] = []
        self.values: list[ca.MX] = []

    def add(
        self, sparsity: ca.Sparsity, first_rows: list[int], first_columns: list[int], values: ca.MX
    ) -> None:
        """Add one block at each pair of offsets; `values` holds a column of nonzeros a block."""
        rows, columns = (np.array(part, dtype=int) for part in sparsity.get_triplet())
        self.rows.append((np.array(first_rows, dtype=int)[:, None] + rows[None, :]).ravel())
        self.columns.append((np.array(first_columns, dtype=int)[:, None] + columns[None, :]).ravel())
        self.values.append(ca.vec(values))

    def matrix(self, mirrored: bool) -> ca.MX:
        """The sparse matrix; mirrored, its strictly upper entries appear below the diagonal too."""
        rows, columns = np.concatenate(self.rows), np.concatenate(self.columns)
        source = np.arange(rows.size)
        if mirrored:
            off = rows != columns
            rows, columns = np.concatenate([rows, columns[off]]), np.concatenate([columns, rows[off]])
            source = np.concatenate([source, source[off]])
        order = np.lexsort((rows, columns))
        sparsity = ca.Sparsity.triplet(*self.shape, rows[order].tolist(), columns[order].tolist())
        if sparsity.nnz() != rows.size:
            raise ValueError("two blocks hold the same entry")
        return ca.MX(sparsity, ca.vertcat(*self.values)[source[order].tolist()])
