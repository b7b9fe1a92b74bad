"""Operations of the service: each makes requests and reads their answers. See ``verne.session``."""
