"""What a run costs and how exact it is: `make bench` writes the report."""
