// SPDX-License-Identifier: BSD-3-Clause
// Empty: the headers of its target are what is compiled.
