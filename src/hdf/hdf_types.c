#include "hdf/hdf_types.h"

hid_t gb_hdf_types_memory(enum gb_hdf_type type)
{
    switch (type) {
    case GB_HDF_DOUBLE:
        return H5T_NATIVE_DOUBLE;
    case GB_HDF_INT32:
        return H5T_NATIVE_INT32;
    case GB_HDF_INT64:
        return H5T_NATIVE_INT64;
    case GB_HDF_UINT64:
        return H5T_NATIVE_UINT64;
    case GB_HDF_FLOAT:
        return H5T_NATIVE_FLOAT;
    default:
        return H5T_NATIVE_UINT8;
    }
}

hid_t gb_hdf_types_file(enum gb_hdf_type type)
{
    switch (type) {
    case GB_HDF_DOUBLE:
    case GB_HDF_FLOAT:
        return H5T_IEEE_F64LE;
    case GB_HDF_INT32:
        return H5T_STD_I32LE;
    case GB_HDF_INT64:
        return H5T_STD_I64LE;
    case GB_HDF_UINT64:
        return H5T_STD_U64LE;
    default:
        return H5T_STD_U8LE;
    }
}

size_t gb_hdf_types_bytes(enum gb_hdf_type type)
{
    switch (type) {
    case GB_HDF_INT32:
    case GB_HDF_FLOAT:
        return 4;
    case GB_HDF_UINT8:
        return 1;
    default:
        return 8;
    }
}

bool gb_hdf_types_fit(hid_t type, enum gb_hdf_type wanted)
{
    const hid_t model = gb_hdf_types_file(wanted);
    const H5T_class_t class = H5Tget_class(type);
    return class == H5Tget_class(model) && H5Tget_size(type) == H5Tget_size(model) &&
           (class != H5T_INTEGER || H5Tget_sign(type) == H5Tget_sign(model));
}
