# Tunica on Debian 12, built, with its programs on the path.
#
#   docker build -t tunica .
#   docker run --rm -v "$PWD/results:/opt/tunica/results" tunica        # the pulse, and its pictures
#   docker run --rm -it -v "$PWD:/data" -w /data tunica tunica-check my-case.xml
FROM debian:12

# Containers run as root and forbid the system calls with which ranks read each other's memory.
ENV OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_mpi_yield_when_idle=1 \
    OMP_NUM_THREADS=1 PATH=/opt/tunica/build/release/bin:$PATH
WORKDIR /opt/tunica

# The packages by themselves: they change less often than the sources.
COPY cmake/apt-packages.txt cmake/
RUN apt-get update \
 && xargs -a cmake/apt-packages.txt env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y --no-install-recommends \
 && rm -rf /var/lib/apt/lists/*

COPY . .
RUN cmake --preset release && cmake --build --preset release --target drivers/all

CMD ["./quickstart"]
