# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
#
# docker build -t ridgeway . && docker run --rm -v "$PWD:/work" ridgeway build office.bt -o office.ridge
# The steps are those of ./dev bare package and ./dev try-packages, which need no Docker.

# Builds the Debian packages.
FROM debian:12-slim AS builder
COPY . /root/ridgeway
WORKDIR /root/ridgeway
RUN ./dev package

# Has what they need to run, and no compiler.
FROM debian:12-slim
COPY --from=builder /root/ridgeway/build/ridgeway_*.deb /root/ridgeway/build/python3-ridgeway_*.deb /tmp/packages/
RUN apt-get update \
  && apt-get install -y --no-install-recommends /tmp/packages/*.deb \
  && rm -rf /tmp/packages /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["ridgeway"]
CMD ["--help"]
